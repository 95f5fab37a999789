import type { IncomingMessage } from 'node:http';
import { describe, expect, test } from 'vitest';
import { addressKey, peerAddress } from './peer-address.ts';

describe('addresses', () => {
  test.each([
    ['192.0.2.1', '192.0.2.1'],
    ['2001:db8:1:2:3:4:5:6', '2001:db8:1:2::/64'],
    ['2001:db8::6', '2001:db8:0:0::/64'],
    ['::1', '0:0:0:0::/64'],
    ['2001:db8:1:2::', '2001:db8:1:2::/64'],
  ])('%s counts as %s', (address, key) => {
    expect(addressKey(address)).toBe(key);
  });

  test('are the socket’s, or with a trusted proxy the last one that it names', () => {
    const request = {
      headers: { 'x-forwarded-for': '203.0.113.9, 192.0.2.7' },
      socket: { remoteAddress: '::ffff:127.0.0.1' },
    } as unknown as IncomingMessage;
    expect([peerAddress(request, false), peerAddress(request, true)]).toEqual(['127.0.0.1', '192.0.2.7']);
  });
});
