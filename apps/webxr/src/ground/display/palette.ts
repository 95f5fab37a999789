/** The theme's colours for what is drawn on a canvas: maps, curves and small pictures. theme.css is where they are defined. */

const NAMES = [
  'ground',
  'control',
  'line',
  'axis',
  'text',
  'quiet',
  'good',
  'stale',
  'very-near',
  'near',
  'far',
  'drop',
] as const;

/** CSS colours. They change with the theme: read them when drawing, and draw again when `version` changes. */
export type Palette = { [Name in (typeof NAMES)[number]]: string } & { version: number };

/** Before the style sheets are read, in the text's own colour. */
export const palette: Palette = {
  ...(Object.fromEntries(NAMES.map((name) => [name, 'currentColor'])) as Record<
    (typeof NAMES)[number],
    string
  >),
  version: 0,
};

/** Takes over the colours of the theme that the page has now. @param style of the document's root */
export function readPalette(style: Pick<CSSStyleDeclaration, 'getPropertyValue'>): void {
  for (const name of NAMES) {
    const colour = style.getPropertyValue(`--${name}`).trim();
    if (colour !== '') palette[name] = colour;
  }
  palette.version++;
}
