/** The few parts of SVG that the plots need, written as text. */

export type Attributes = Record<string, string | number | undefined>;

export function element(name: string, attributes: Attributes, ...children: string[]): string {
  const pairs = Object.entries(attributes).filter(([, value]) => value !== undefined);
  const text = pairs
    .map(([key, value]) => ` ${key}="${escapeText(shorten(value as string | number))}"`)
    .join('');
  return children.length === 0 ? `<${name}${text}/>` : `<${name}${text}>${children.join('')}</${name}>`;
}

export function escapeText(text: string): string {
  return text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');
}

/** A path through points in pixels; a NaN in either coordinate breaks the line. */
export function linePath(points: Iterable<readonly [number, number]>): string {
  let path = '';
  let pen = 'M';
  for (const [x, y] of points) {
    if (Number.isNaN(x + y)) {
      pen = 'M';
      continue;
    }
    path += `${pen}${shorten(x)} ${shorten(y)}`;
    pen = 'L';
  }
  return path;
}

function shorten(value: string | number): string {
  return typeof value === 'number' ? String(Math.round(value * 100) / 100) : value;
}
