import { describe, expect, test } from 'vitest';
import { isLocalAddress, localAddresses } from './local-addresses.ts';
import { isLocalName } from './local-names.ts';

describe('addresses of local networks', () => {
  test.each([
    '10.0.0.1',
    '172.16.0.1',
    '172.31.255.254',
    '192.168.1.20',
    '169.254.3.4',
    '100.64.0.1',
    '127.0.0.1',
  ])('%s is one', (address) => expect(isLocalAddress(address)).toBe(true));
  test.each(['fd12::1', 'fe80::1', '::1'])('%s is one', (address) =>
    expect(isLocalAddress(address)).toBe(true),
  );
  test.each([
    '8.8.8.8',
    '172.32.0.1',
    '172.15.0.1',
    '192.169.0.1',
    '100.128.0.1',
    '2001:db8::1',
    '::',
    'robot.local',
    '',
  ])('“%s” is none', (address) => expect(isLocalAddress(address)).toBe(false));
});

describe('names of local networks', () => {
  test.each(['robot.local', 'localhost', 'a.localhost', 'yard.home.arpa', 'x-1.internal'])(
    '%s is one',
    (name) => expect(isLocalName(name)).toBe(true),
  );
  test.each([
    'example.com',
    'local.example',
    'notlocal',
    'xlocal',
    'Robot.local',
    '.local',
    'a..local',
    '-a.local',
    '',
  ])('“%s” is none', (name) => expect(isLocalName(name)).toBe(false));
});

test('of a machine’s addresses, those that a headset can reach, real interfaces first', () => {
  const found = localAddresses({
    lo: [{ address: '127.0.0.1', internal: true }],
    docker0: [{ address: '172.17.0.1', internal: false }],
    wlan0: [
      { address: 'fe80::1', internal: false },
      { address: '192.168.1.20', internal: false },
    ],
    eth0: [{ address: '8.8.4.4', internal: false }],
    tun0: undefined,
  });
  expect(found).toEqual([
    { address: '192.168.1.20', name: 'wlan0' },
    { address: '172.17.0.1', name: 'docker0' },
  ]);
});
