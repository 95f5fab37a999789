import type { IncomingMessage } from 'node:http';
import fc from 'fast-check';
import { describe, expect, it, test } from 'vitest';
import { addressKey, forwardedAddress, peerAddress, plainAddress } from './peer-address.ts';
import { proxies, TrustedProxies } from './trusted-proxies.ts';

const from = (remoteAddress: string, forwarded?: string, trusted: string[] = ['loopback', '10.1.0.0/16']) =>
  peerAddress(
    { headers: { 'x-forwarded-for': forwarded }, socket: { remoteAddress } } as unknown as IncomingMessage,
    new TrustedProxies(trusted),
  );

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

  test.each([
    ['::ffff:127.0.0.1', '127.0.0.1'],
    ['::FFFF:7f00:1', '127.0.0.1'],
    ['2001:0DB8:0:0:0:0:0:1', '2001:db8::1'],
    ['fe80::1%eth0', 'fe80::1'],
    ['192.0.2.1', '192.0.2.1'],
    ['unknown', 'unknown'],
  ])('%s is %s', (address, plain) => {
    expect(plainAddress(address)).toBe(plain);
  });

  test.each([
    ['203.0.113.10', '203.0.113.10'],
    ['203.0.113.10:4711', '203.0.113.10'],
    [' [2001:db8::1]:443', '2001:db8::1'],
    ['"[2001:db8::1]:443"', '2001:db8::1'],
    ['[2001:db8::1]', '2001:db8::1'],
    ['2001:DB8::0:1', '2001:db8::1'],
    ['[::ffff:203.0.113.10]:1', '203.0.113.10'],
    ['_hidden', null],
    ['unknown', null],
    ['', null],
    ['203.0.113.10:4711:1', null],
    ['203.0.113:80', null],
  ])('a proxy’s %j is %s', (text, address) => {
    expect(forwardedAddress(text)).toBe(address);
  });
});

describe('who asks', () => {
  test.each([
    ['only a trusted proxy is believed', '198.51.100.1', '203.0.113.9', '198.51.100.1'],
    ['the last one that is no proxy', '::ffff:127.0.0.1', '203.0.113.9, 192.0.2.7', '192.0.2.7'],
    ['behind a second proxy', '127.0.0.1', '203.0.113.9, 192.0.2.7:99, 10.1.2.3:80', '192.0.2.7'],
    ['a proxy that says nothing', '127.0.0.1', undefined, '127.0.0.1'],
    ['proxies alone', '127.0.0.1', '10.1.2.3', '10.1.2.3'],
    ['a hop that is no address', '127.0.0.1', '203.0.113.9, unknown, 10.1.2.3', '10.1.2.3'],
  ])('%s', (_, socket, forwarded, address) => {
    expect(from(socket, forwarded)).toBe(address);
  });

  it('is the same whatever port a gateway adds and whatever the peer has written before', () => {
    fc.assert(
      fc.property(
        fc.ipV4(),
        fc.integer({ min: 1, max: 65535 }),
        fc.string().filter((text) => !text.includes('\n')),
        (address, port, forged) => {
          const trusted = new TrustedProxies(['loopback', '10.1.0.0/16']);
          fc.pre(!trusted.has(address));
          expect(from('127.0.0.1', `${forged},${address}:${port}`)).toBe(address);
          expect(from(address, forged)).toBe(address);
        },
      ),
    );
  });
});

test('an option names proxies by addresses, networks and two words', () => {
  const read = (value: unknown) => proxies().safeParse(value).success;
  expect(read('loopback, 10.0.0.0/8, 2001:db8::/32, 192.0.2.1')).toBe(true);
  for (const bad of ['true', true, 'proxy.example', '10.0.0.0/33', '10.0.0/8', '::/129', '10.0.0.1:80'])
    expect(read(bad), String(bad)).toBe(false);
  const own = new TrustedProxies(['private', '2001:db8::/32']);
  expect(
    ['192.168.7.1', 'fe80::1', '2001:db8:9::1', '8.8.8.8', 'unknown'].map((each) => own.has(each)),
  ).toEqual([...[true, true, true, false, false]]);
});
