/** Where raster tiles of a map come from, as the operator has set it. Without a setting, none are fetched. */

export interface MapTiles {
  /** With `{z}`, `{x}` and `{y}`. */
  readonly template: string;
  /** Shown on the map; `null`: nobody has written one. */
  readonly attribution: string | null;
  /** The server's. */
  readonly host: string;
}

/**
 * Characters of an address and of a note of its owner. Chosen: above the longest in use; below what a line
 * shows.
 */
export const MOST_TEXT = 512;
const MOST_ATTRIBUTION = 120;

/** What is wrong with an address. */
export type TileFault =
  | 'too-long'
  | 'misses-number'
  | 'number-in-host'
  | 'no-address'
  | 'not-https'
  | 'has-password';

/** @returns the checked template, or what is wrong with it */
export function parseTileTemplate(
  text: string,
  page: { readonly protocol: string; readonly host: string },
): { template: string } | { fault: TileFault } {
  const template = text.trim();
  if (template.length > MOST_TEXT) return { fault: 'too-long' };
  for (const part of ['{z}', '{x}', '{y}']) if (!template.includes(part)) return { fault: 'misses-number' };
  const urlOf = (number: string) =>
    new URL(template.replaceAll(/\{[xyz]\}/g, number), `${page.protocol}//${page.host}/`);
  let url: URL;
  try {
    url = urlOf('0');
    // Otherwise a tile's number could choose the server.
    if (urlOf('7').origin !== url.origin) return { fault: 'number-in-host' };
  } catch {
    return { fault: 'no-address' };
  }
  const isSameHost = url.host === page.host && url.protocol === page.protocol;
  if (url.protocol !== 'https:' && !isSameHost) return { fault: 'not-https' };
  if (url.username !== '' || url.password !== '') return { fault: 'has-password' };
  return { template };
}

/** @returns `null` if there is no template that can be used */
export function mapTilesOf(
  template: string | undefined,
  attribution: string | undefined,
  page: { readonly protocol: string; readonly host: string },
): MapTiles | null {
  if (template === undefined || template.trim() === '') return null;
  const parsed = parseTileTemplate(template, page);
  if ('fault' in parsed) return null;
  const text = attribution?.trim() ?? '';
  const host = new URL(parsed.template.replaceAll(/[{}]/g, ''), `${page.protocol}//${page.host}/`).host;
  return {
    template: parsed.template,
    attribution: text === '' ? null : text.slice(0, MOST_ATTRIBUTION),
    host,
  };
}

export function tileUrl({ template }: MapTiles, z: number, x: number, y: number): string {
  return template.replaceAll('{z}', String(z)).replaceAll('{x}', String(x)).replaceAll('{y}', String(y));
}
