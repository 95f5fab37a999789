/**
 * What a cloud's shaders can do, and mostly need not: each is compiled in only while it is used. A renderer without a
 * graphics processor runs both sides of a branch for every point, so a uniform that switches something off saves nothing.
 */
import type { Material, Vector2, Vector4 } from 'three';
import { COLOUR_MODES } from './cloud-colouring.ts';

/** Names of the preprocessor's symbols; a feature's bit is its index. */
const SYMBOLS = ['COLOURED', 'LIT', 'HEIGHT_CUT', 'HAZARDS'] as const;
const [COLOURED, LIT, HEIGHT_CUT, HAZARDS] = [1, 2, 4, 8];

/** Heights without a limit, metres. */
export const UNLIMITED_M = 1e30;

/** `isCut(height)`: whether a height in the world is outside of what is drawn. Needs the uniform `heightCut`. */
export const HEIGHT_CUT_FUNCTION = /* glsl */ `
bool isCut(float height) {
#ifdef HEIGHT_CUT
  return height < heightCut.x || height > heightCut.y;
#else
  return false;
#endif
}
`;

/** The uniforms that say what is used. */
export interface FeatureUniforms {
  /** Index in the list of colour modes (cloud-colouring.ts); a shader without modes has none. */
  colourMode?: { value: number };
  heightCut: { value: Vector2 };
  hazardBand: { value: Vector4 };
}

const LIT_MODE = COLOUR_MODES.indexOf('lit');

/** @returns the features that the uniforms' values need, as bits. */
export function featuresOf({ colourMode, heightCut, hazardBand }: FeatureUniforms): number {
  const mode = colourMode?.value ?? 0;
  const { x, y } = heightCut.value;
  return (
    (mode === 0 ? 0 : COLOURED) |
    (mode === LIT_MODE ? LIT : 0) |
    (x > -UNLIMITED_M || y < UNLIMITED_M ? HEIGHT_CUT : 0) |
    (hazardBand.value.y === 0 ? 0 : HAZARDS)
  );
}

/** Compiles these features in, and no others. Does nothing, and allocates nothing, if they are as before. */
export function setFeatures(material: Material, features: number): void {
  if (featuresIn(material) === features) return;
  material.defines = Object.fromEntries(
    SYMBOLS.filter((_, bit) => (features & (1 << bit)) !== 0).map((symbol) => [symbol, '']),
  );
  material.userData.features = features;
  material.needsUpdate = true;
}

function featuresIn(material: Material): number {
  return (material.userData.features as number | undefined) ?? 0;
}
