/** The contrast of what is read, in each theme, over a white and over a black picture. */
import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';

type Rgb = readonly [red: number, green: number, blue: number];

const css = readFileSync(new URL('theme.css', import.meta.url), 'utf8');
/** All but the palette itself, and what a library brings. */
const STYLE_SHEETS = ['./', '../dashboard/', '../events/', '../help/'].flatMap((folder) =>
  readdirSync(new URL(folder, import.meta.url))
    .filter((name) => name.endsWith('.css') && name !== 'theme.css')
    .map((name) => readFileSync(new URL(folder + name, import.meta.url), 'utf8')),
);

function coloursOf(selector: string): Map<string, string> {
  const start = css.indexOf(`${selector} {`);
  const block = css.slice(start, css.indexOf('}', start));
  return new Map(
    [...block.matchAll(/--([a-z-]+): (#[0-9a-f]{6,8});/g)].map(([, name, value]) => [name!, value!]),
  );
}

const dark = coloursOf(':root');
const themes = [
  ['dark', dark],
  ['light', new Map([...dark, ...coloursOf(':root[data-theme="light"]')])],
  ['contrast', new Map([...dark, ...coloursOf(':root[data-theme="contrast"]')])],
] as const;

function parts(colour: string): { rgb: Rgb; alpha: number } {
  const [red, green, blue, alpha = 255] = (colour.slice(1).match(/../g) ?? []).map((pair) =>
    Number.parseInt(pair, 16),
  );
  return { rgb: [red!, green!, blue!], alpha: alpha / 255 };
}

/** A colour over a picture of one grey. */
function over(colour: string, picture: number): Rgb {
  const { rgb, alpha } = parts(colour);
  return rgb.map((level) => level * alpha + picture * (1 - alpha)) as unknown as Rgb;
}

/** WCAG 2.2: relative luminance. */
function luminance(rgb: Rgb): number {
  const [red, green, blue] = rgb.map((level) => {
    const share = level / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  }) as unknown as Rgb;
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

function contrast(one: Rgb, other: Rgb): number {
  const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b) as [number, number];
  return (high + 0.05) / (low + 0.05);
}

/** WCAG 2.2, 1.4.3: text; 1.4.11: what is drawn and must be told apart. */
const TEXT = 4.5;
const DRAWN = 3;

const TONES = ['text', 'quiet', 'good', 'warning', 'bad'];
const READ: readonly (readonly [ground: string, texts: readonly string[]])[] = [
  ...['ground', 'sheet', 'control', 'panel', 'overlay', 'control-over'].map(
    (ground) => [ground, TONES] as const,
  ),
  ['sheet', ['faint']],
  ['ground', ['faint']],
  ['warning-ground', ['warning', 'text']],
  ['bad-ground', ['bad', 'text']],
  ['good', ['on-good']],
  ['held-ground', ['text']],
  ['stop-light', ['on-stop']],
  ['stop', ['on-stop']],
  ['latched', ['on-latched']],
  ['band-ground', ['on-stop']],
  ['banner-ground', ['on-stop']],
];

describe.each(themes)('%s', (_, colours) => {
  const colour = (name: string) => colours.get(name) as string;

  test('has all colours', () => {
    expect(colours.size).toBe(dark.size);
    expect(dark.size).toBeGreaterThan(30);
  });

  test('text can be read over a white and over a black picture', () => {
    const faint = READ.flatMap(([ground, texts]) =>
      texts.flatMap((text) =>
        [0, 255].flatMap((picture) => {
          const found = contrast(parts(colour(text)).rgb, over(colour(ground), picture));
          return found >= TEXT ? [] : [`${text} on ${ground} over ${picture}: ${found.toFixed(2)}`];
        }),
      ),
    );
    expect(faint).toEqual([]);
  });

  test('what is drawn on maps, curves and the near field can be told from its ground', () => {
    const drawn = [
      ...['good', 'stale', 'text'].map((name) => [name, 'ground'] as const),
      ...['good', 'stale'].map((name) => [name, 'sheet'] as const),
      ...['very-near', 'near', 'far', 'drop', 'stale', 'good'].map((name) => [name, 'overlay'] as const),
    ];
    const faint = drawn.flatMap(([name, ground]) => {
      // The theme's own ground: a picture behind it changes little.
      const found = contrast(parts(colour(name)).rgb, parts(colour(ground)).rgb);
      return found >= DRAWN ? [] : [`${name} on ${ground}: ${found.toFixed(2)}`];
    });
    expect(faint).toEqual([]);
  });
});

/** Custom properties that are no colours. */
const OTHERS = [
  'stop-scale',
  'scale',
  'text-scale',
  'dashboard',
  'x',
  'y',
  'stop-size',
  'stop-room',
  'stop-beside',
  'stop-edge',
  'edge-left',
  'edge-right',
  'pictures',
  'joystick-size',
];

test('all colours of the style sheets are the themes’', () => {
  for (const sheet of STYLE_SHEETS) {
    const literal = [...sheet.matchAll(/[:,(] ?(#[0-9a-f]{3,8}\b|rgba?\()/g)].map(([, found]) => found);
    expect(literal).toEqual([]);
    for (const [, name] of sheet.matchAll(/var\(--([a-z-]+)\)/g))
      expect([...dark.keys(), ...OTHERS]).toContain(name);
  }
});
