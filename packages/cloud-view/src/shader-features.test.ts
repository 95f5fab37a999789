import { Vector2, Vector4 } from 'three';
import { expect, it } from 'vitest';
import { COLOUR_MODES } from './cloud-colouring.ts';
import { createPointMaterial } from './point-material.ts';
import { featuresOf, setFeatures, UNLIMITED_M } from './shader-features.ts';

function plain() {
  return {
    colourMode: { value: 0 },
    heightCut: { value: new Vector2(-UNLIMITED_M, UNLIMITED_M) },
    hazardBand: { value: new Vector4() },
  };
}

function symbolsFor(change: (uniforms: ReturnType<typeof plain>) => void): string[] {
  const { material } = createPointMaterial();
  const uniforms = plain();
  change(uniforms);
  setFeatures(material, featuresOf(uniforms));
  return Object.keys(material.defines ?? {});
}

it('compiles in nothing for a cloud in its own colours', () => {
  expect(symbolsFor(() => undefined)).toEqual([]);
});

it('compiles in what is used', () => {
  for (const mode of COLOUR_MODES) {
    const expected = mode === 'captured' ? [] : mode === 'lit' ? ['COLOURED', 'LIT'] : ['COLOURED'];
    expect(
      symbolsFor(({ colourMode }) => {
        colourMode.value = COLOUR_MODES.indexOf(mode);
      }),
      mode,
    ).toEqual(expected);
  }
  expect(symbolsFor(({ heightCut }) => heightCut.value.setX(0))).toEqual(['HEIGHT_CUT']);
  expect(symbolsFor(({ heightCut }) => heightCut.value.setY(2))).toEqual(['HEIGHT_CUT']);
  expect(symbolsFor(({ hazardBand }) => hazardBand.value.setY(1))).toEqual(['HAZARDS']);
});

it('compiles again only after a change', () => {
  const { material } = createPointMaterial();
  const uniforms = plain();
  const { version } = material;
  setFeatures(material, featuresOf(uniforms));
  expect(material.version).toBe(version);
  uniforms.hazardBand.value.setY(1);
  setFeatures(material, featuresOf(uniforms));
  setFeatures(material, featuresOf(uniforms));
  expect(material.version).toBe(version + 1);
  uniforms.hazardBand.value.setY(0);
  setFeatures(material, featuresOf(uniforms));
  expect(material.version).toBe(version + 2);
  expect(material.defines).toEqual({});
});
