import { describe, expect, it } from 'vitest';
import { pageAddress, readWallSettings, wallAddress } from './wall-settings.ts';

const read = (query: string) => readWallSettings(new URLSearchParams(query));

describe('the wall’s address', () => {
  it('names up to four robots, once each, and leaves nonsense out', () => {
    expect(read('robots=a,b').robots).toEqual(['a', 'b']);
    expect(read('robots=a,a,%3Cb%3E,,c').robots).toEqual(['a', 'c']);
    expect(read('robots=a,b,c,d,e').robots).toEqual(['a', 'b', 'c', 'd']);
  });

  it('has a page to choose a robot on if it names none', () => {
    for (const query of ['', 'robots=', 'robots=%3C%3E']) expect(read(query).robots).toEqual([null]);
  });

  it('hands everything else on to each page', () => {
    const { forPages } = read('robots=a,b&signaling=wss%3A%2F%2Fx.org&cues=0&robot=z');
    expect(pageAddress('a', forPages)).toBe('./?signaling=wss%3A%2F%2Fx.org&cues=0&robot=a');
    expect(pageAddress(null, new URLSearchParams())).toBe('./');
    expect(wallAddress(['a', 'b'], new URLSearchParams('cues=0'))).toBe('./wall.html?cues=0&robots=a,b');
    expect(wallAddress([], new URLSearchParams())).toBe('./wall.html');
  });
});
