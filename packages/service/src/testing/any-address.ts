import fc from 'fast-check';

const SAFE = [..."abcXYZ019-._~!$&'()*+,;=:@"];
const part = fc.array(fc.oneof(fc.constantFrom(...SAFE), fc.integer({ min: 0, max: 0x10ffff }).map(escaped)));

/** The addresses of web pages, without a fragment. `fc.webUrl` takes a second to begin. */
export const anyAddress = fc
  .tuple(fc.constantFrom('http', 'https'), fc.domain(), fc.array(part), fc.option(part))
  .map(([scheme, domain, path, query]) => {
    const asked = query === null ? '' : `?${query.join('')}`;
    return `${scheme}://${domain}${path.map((each) => `/${each.join('')}`).join('')}${asked}`;
  });

/** Halves of surrogate pairs cannot be written. */
function escaped(code: number): string {
  return encodeURIComponent(String.fromCodePoint(code).toWellFormed());
}
