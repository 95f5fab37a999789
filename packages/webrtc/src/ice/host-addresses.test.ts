import { describe, expect, it } from 'vitest';
import { hostAddresses, type Interfaces } from './host-addresses.ts';

const v4 = (address: string) => ({ address, family: 'IPv4', internal: false }) as const;
const v6 = (address: string) => ({ address, family: 'IPv6', internal: false }) as const;
const LOOPBACK = [
  { ...v4('127.0.0.1'), internal: true },
  { ...v6('::1'), internal: true },
];

const offered = (interfaces: Interfaces) => hostAddresses(interfaces).map(({ address }) => address);

describe('hostAddresses', () => {
  it.each([
    ...['eth0', 'enp3s0', 'wlan0', 'wwan0', 'usb0', 'en0', 'Ethernet', 'Wi-Fi', 'vEthernet (WSL)'],
    ...['br0', 'br-lan'],
    ...['tun0', 'tap1', 'utun4', 'ipsec0', 'wg0', 'tailscale0', 'ztabcdef12', 'ppp0', 'veth3f9a1c', 'my-vpn'],
    ...['docker0', 'br-0123456789ab', 'virbr0', 'vmnet8', 'cni0'],
  ])('offers both families of %s where there is nothing else', (name) => {
    expect(hostAddresses({ lo: LOOPBACK, [name]: [v6('fd00::2'), v4('10.0.0.2'), v6('fe80::2')] })).toEqual([
      { name, address: '10.0.0.2' },
      { name, address: 'fd00::2' },
    ]);
  });

  it.each([
    ['nothing', {}],
    ['loopback', { lo: LOOPBACK }],
    ['an interface without addresses', { eth0: [], wlan0: undefined }],
    [
      'IPv6 link-local addresses',
      { eth0: [v6('fe80::1'), v6('FE80::2'), v6('febf::3')], tun0: [v6('fe90::1')] },
    ],
  ])('offers nothing where there is only %s', (_, interfaces: Interfaces) => {
    expect(offered(interfaces)).toEqual([]);
  });

  it.each<[string, Interfaces, string[]]>([
    [
      'ordinary networks before tunnels, each by name',
      {
        tun0: [v4('10.8.0.2')],
        ipsec0: [v4('10.9.0.2')],
        wlan0: [v4('192.168.1.6')],
        eth0: [v4('192.168.1.5'), v6('2001:db8::5')],
        utun3: [v6('fd7a::2'), v4('100.64.0.2')],
      },
      ['192.168.1.5', '2001:db8::5', '192.168.1.6', '10.9.0.2', '10.8.0.2', '100.64.0.2', 'fd7a::2'],
    ],
    [
      'no bridge of guests beside a network',
      { docker0: [v4('172.17.0.1')], 'br-0123456789ab': [v4('172.18.0.1')], eth0: [v4('192.168.1.5')] },
      ['192.168.1.5'],
    ],
    [
      'no bridge of guests beside a tunnel',
      { docker0: [v4('172.17.0.1')], wg0: [v4('10.8.0.2')] },
      ['10.8.0.2'],
    ],
    [
      'a namespace’s cable beside its tunnel',
      { veth1: [v4('10.200.0.2')], tun0: [v4('10.8.0.2')] },
      ['10.200.0.2', '10.8.0.2'],
    ],
    [
      'no IPv4 link-local address beside another one',
      { eth0: [v4('169.254.7.7')], wlan0: [v4('192.168.1.6')] },
      ['192.168.1.6'],
    ],
    [
      'IPv4 link-local addresses on a cable, before bridges of guests',
      { docker0: [v4('172.17.0.1')], eth0: [v4('169.254.7.7'), v6('fe80::7')] },
      ['169.254.7.7', '172.17.0.1'],
    ],
  ])('offers %s', (_, interfaces, addresses) => {
    expect(offered(interfaces)).toEqual(addresses);
  });

  it('offers four addresses of an interface, and sixteen in all, the tunnels’ last', () => {
    const many = (prefix: string) => Array.from({ length: 40 }, (_, index) => v6(`${prefix}::${index + 1}`));
    expect(offered({ eth0: [...many('fd00'), v4('10.0.0.2')], tun0: [v4('10.8.0.2')] })).toEqual([
      ...['10.0.0.2', 'fd00::1', 'fd00::2', 'fd00::3', '10.8.0.2'],
    ]);
    const names = Array.from({ length: 10 }, (_, index) => [`eth${index}`, many(`fd0${index}`)] as const);
    const all = offered({ ...Object.fromEntries(names), tun0: [v4('10.8.0.2')] });
    expect(all).toHaveLength(16);
    expect(all).not.toContain('10.8.0.2');
  });
});
