import { describe, expect, test } from 'vitest';
import { isLoopback } from '../../serve/broadcast/broadcast-options.ts';
import { broadcastOptions, toBroadcast } from './broadcast.ts';

type Values = Parameters<typeof toBroadcast>[0];
const defaults = Object.fromEntries(
  Object.entries(broadcastOptions).map(([key, { default: value }]) => [key, value]),
) as Values;

function read(values: Partial<Values>) {
  const refused: string[] = [];
  const broadcast = toBroadcast({ ...defaults, ...values }, null, (key, detail) =>
    refused.push(`${key} ${detail}`),
  );
  return { broadcast, refused };
}

describe('the broadcast', () => {
  test('is off by default', () => {
    expect(read({})).toEqual({ broadcast: undefined, refused: [] });
  });

  test('goes to this machine in clear', () => {
    const { broadcast, refused } = read({ broadcastJanus: 'ws://127.0.0.1:8188', broadcastMbps: 3 });
    expect(refused).toEqual([]);
    expect(broadcast).toMatchObject({ mountpoint: 1, bitsPerSecond: 3e6, keyFrameMs: 2000, clouds: true });
  });

  test('goes to another machine over wss:// only, unless that is allowed', () => {
    const broadcastJanus = 'ws://janus.example.org:8188';
    expect(read({ broadcastJanus }).refused[0]).toContain('must be a wss:// address');
    expect(read({ broadcastJanus, plaintextToken: true }).refused).toEqual([]);
    expect(read({ broadcastJanus: 'wss://janus.example.org' }).refused).toEqual([]);
  });

  test.each([
    ['localhost', true],
    ['127.0.0.1', true],
    ['127.1.2.3', true],
    ['[::1]', true],
    ['127.0.0.1.example.org', false],
    ['10.0.0.1', false],
  ])('%s is this machine: %j', (host, is) => {
    expect(isLoopback(host)).toBe(is);
  });
});
