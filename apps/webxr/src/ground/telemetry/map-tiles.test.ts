import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { mapTilesOf, parseTileTemplate, tileUrl } from './map-tiles.ts';

const page = { protocol: 'http:', host: 'robot.local:3000' };
const faultOf = (text: string) => {
  const parsed = parseTileTemplate(text, page);
  return 'fault' in parsed ? parsed.fault : null;
};

describe('the address of map tiles', () => {
  test('is https, or on the page’s own server', () => {
    expect(faultOf('https://tiles.example/{z}/{x}/{y}.png')).toBeNull();
    expect(faultOf('/tiles/{z}/{x}/{y}.png')).toBeNull();
    expect(faultOf('/{z}/{x}/{y}')).toBeNull();
    expect(faultOf('http://robot.local:3000/{z}/{x}/{y}')).toBeNull();
    expect(faultOf('http://tiles.example/{z}/{x}/{y}.png')).toBe('not-https');
    expect(faultOf('//tiles.example/{z}/{x}/{y}.png')).toBe('not-https');
    expect(faultOf('javascript:{z}{x}{y}')).toBe('not-https');
    expect(faultOf('https://tiles.example/{z}/{x}.png')).toBe('misses-number');
    expect(faultOf('https://user:secret@tiles.example/{z}/{x}/{y}')).toBe('has-password');
    expect(faultOf('https://{x}.example/{z}/{y}')).toBe('number-in-host');
    expect(faultOf(`https://tiles.example/{z}/{x}/{y}${'a'.repeat(512)}`)).toBe('too-long');
  });

  test('never names another server than it was checked for', () => {
    const tile = fc.nat(1e6);
    fc.assert(
      fc.property(fc.string({ maxLength: 40 }), tile, tile, (text, x, y) => {
        const template = `https://tiles.example/${text}{z}/{x}/{y}`;
        const tiles = mapTilesOf(template, undefined, page);
        if (tiles === null) return;
        expect(new URL(tileUrl(tiles, 12, x, y)).host).toBe('tiles.example');
      }),
      { seed: 1, numRuns: 500 },
    );
  });

  test('has an attribution, or at least a server to name', () => {
    expect(mapTilesOf('https://tiles.example/{z}/{x}/{y}', ' ', page)).toMatchObject({
      attribution: null,
      host: 'tiles.example',
    });
    expect(mapTilesOf('/t/{z}/{x}/{y}', '© Us', page)?.attribution).toBe('© Us');
    expect(mapTilesOf('ftp://x/{z}/{x}/{y}', '', page)).toBeNull();
    expect(mapTilesOf('', '', page)).toBeNull();
    expect(mapTilesOf(undefined, undefined, page)).toBeNull();
  });
});
