import { describe, expect, it } from 'vitest';
import { KnownSources } from './known-sources.ts';

describe('KnownSources', () => {
  it('identifies an address by host and port', () => {
    const sources = new KnownSources();
    sources.add('192.0.2.1', 1000);
    expect(sources.has('192.0.2.1', 1000)).toBe(true);
    expect(sources.has('192.0.2.1', 1000)).toBe(true);
    expect(sources.has('192.0.2.1', 1001)).toBe(false);
    expect(sources.has('192.0.2.2', 1000)).toBe(false);
  });

  it('when full, forgets the oldest address, even if it was the last one looked up', () => {
    const sources = new KnownSources();
    sources.add('192.0.2.1', 0);
    expect(sources.has('192.0.2.1', 0)).toBe(true);
    for (let port = 1; port <= 32; port++) sources.add('192.0.2.1', port);
    expect(sources.has('192.0.2.1', 0)).toBe(false);
    expect(sources.has('192.0.2.1', 1)).toBe(true);
  });
});
