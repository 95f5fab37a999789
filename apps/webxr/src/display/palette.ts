/** The theme's colours for what is drawn on a canvas: maps, curves and small pictures. */

const NAMES = ['ground', 'control', 'line', 'text', 'quiet', 'good', 'stale', 'axis'] as const;

/** CSS colours. They change with the theme: read them when drawing, and draw again when {@link Palette.version} changes. */
export type Palette = { [Name in (typeof NAMES)[number]]: string } & { version: number };

/** The dark theme's, until the style sheets are read. */
export const palette: Palette = {
  ground: '#0b0f14',
  control: '#1b2630',
  line: '#24303b',
  text: '#dbe5ec',
  quiet: '#8fa3b3',
  good: '#35c9b5',
  stale: '#5d6d7a',
  axis: '#33424f',
  version: 0,
};

/** Reads the colours of the theme that the page has now. */
export function readPalette(): void {
  const style = getComputedStyle(document.documentElement);
  for (const name of NAMES) {
    const colour = style.getPropertyValue(`--${name}`).trim();
    if (colour !== '') palette[name] = colour;
  }
  palette.version++;
}
