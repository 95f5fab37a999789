import { describe, expect, test } from 'vitest';
import { readWatchSettings } from './watch-settings.ts';

const read = (query: string, protocol = 'http:') =>
  readWatchSettings(new URLSearchParams(query), { protocol });

describe('the watcher’s settings', () => {
  test('have defaults for all but the address of Janus', () => {
    expect(read('janus=ws://127.0.0.1:8188')).toEqual({
      ...{ url: 'ws://127.0.0.1:8188', mountpoint: 1, pin: undefined, synchronised: true },
    });
    expect(read('janus=wss://j.example.org&mountpoint=7&pin=look&sync=0', 'https:')).toEqual({
      ...{ url: 'wss://j.example.org', mountpoint: 7, pin: 'look', synchronised: false },
    });
  });

  test.each([
    ['', 'http:', 'no-janus'],
    ['janus=example.org', 'http:', 'not-websocket'],
    ['janus=https://example.org', 'http:', 'not-websocket'],
    ['janus=ws://example.org', 'https:', 'needs-wss'],
    ['janus=ws://localhost&mountpoint=0', 'https:', 'bad-mountpoint'],
    ['janus=ws://localhost&mountpoint=1e3', 'http:', 'bad-mountpoint'],
    [`janus=ws://localhost&pin=${'x'.repeat(65)}`, 'http:', 'long-pin'],
  ])('%s, page from %s: says what is wrong', (query, protocol, fault) => {
    expect(read(query, protocol)).toEqual({ fault });
  });
});
