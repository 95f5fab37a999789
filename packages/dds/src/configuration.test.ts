import { describe, expect, it } from 'vitest';
import { cycloneConfiguration, ddsOptionsFrom } from './configuration.ts';
import { faultOf } from './testing/helpers.ts';

describe('options', () => {
  it('are ROS 2’s own by default', () => {
    expect(ddsOptionsFrom({}, {})).toEqual({ domain: 0, localhostOnly: false });
  });

  it('come from ROS’s environment', () => {
    const env = { ROS_DOMAIN_ID: '42', ROS_LOCALHOST_ONLY: '1', ROS_STATIC_PEERS: '10.0.0.7;robot.local;' };
    expect(ddsOptionsFrom({}, env)).toEqual({
      domain: 42,
      localhostOnly: true,
      peers: ['10.0.0.7', 'robot.local'],
    });
    expect(ddsOptionsFrom({}, { ROS_AUTOMATIC_DISCOVERY_RANGE: 'LOCALHOST' })).toMatchObject({
      localhostOnly: true,
    });
    expect(ddsOptionsFrom({}, { ROS_DOMAIN_ID: '', ROS_LOCALHOST_ONLY: '' })).toEqual(ddsOptionsFrom({}, {}));
  });

  it('take precedence over the environment', () => {
    const env = { ROS_DOMAIN_ID: '42', ROS_LOCALHOST_ONLY: '1', ROS_STATIC_PEERS: 'other' };
    expect(ddsOptionsFrom({ domain: 7, interface: 'eth0', peers: ['a'] }, env)).toEqual({
      domain: 7,
      interface: 'eth0',
      localhostOnly: false,
      peers: ['a'],
    });
  });

  it.each([
    [{ domain: 233 }, {}, 'domain'],
    [{ domain: -1 }, {}, 'domain'],
    [{ interface: '"/><x' }, {}, 'interface'],
    [{ peers: ['a b'] }, {}, 'peers'],
    [{ nobody: 1 }, {}, 'nobody'],
    [{}, { ROS_DOMAIN_ID: 'x' }, 'ROS_DOMAIN_ID'],
    [{}, { ROS_DOMAIN_ID: '1.5' }, 'ROS_DOMAIN_ID'],
    [{}, { ROS_LOCALHOST_ONLY: 'yes' }, 'ROS_LOCALHOST_ONLY'],
    [{}, { ROS_STATIC_PEERS: '<' }, 'ROS_STATIC_PEERS'],
  ])('refuses %j with %j, naming %s', (options, env, name) => {
    const fault = faultOf(() => ddsOptionsFrom(options, env));
    expect(fault.code).toBe('unavailable');
    expect(fault.message).toContain(name);
  });
});

describe('configuration', () => {
  it('limits messages and requests buffers for a burst', () => {
    const xml = cycloneConfiguration({});
    expect(xml).toContain('<MaxSampleSize>67108864B</MaxSampleSize>');
    expect(xml).toContain('<SocketReceiveBufferSize min="default" max="16MB"/>');
    expect(xml).not.toContain('NetworkInterface');
    expect(xml).not.toContain('Peers');
  });

  it('restricts itself to the loopback interface on request', () => {
    const xml = cycloneConfiguration({ localhostOnly: true });
    expect(xml).toContain('<NetworkInterface address="127.0.0.1" multicast="true"/>');
    expect(xml).toContain('<Peer Address="localhost"/>');
  });

  it('names interfaces by address or by name', () => {
    expect(cycloneConfiguration({ interface: 'wlan0' })).toContain('<NetworkInterface name="wlan0"/>');
    expect(cycloneConfiguration({ interface: '10.0.0.2' })).toContain(
      '<NetworkInterface address="10.0.0.2"/>',
    );
    expect(cycloneConfiguration({ interface: 'fd00::2' })).toContain('<NetworkInterface address="fd00::2"/>');
  });

  it('searches for peers', () => {
    expect(cycloneConfiguration({ peers: ['10.0.0.7', 'robot.local'] })).toContain(
      '<Peers><Peer Address="10.0.0.7"/><Peer Address="robot.local"/></Peers>',
    );
  });

  it('gives CYCLONEDDS_URI precedence', () => {
    const uri = 'file:///etc/cyclonedds.xml';
    expect(cycloneConfiguration({}, uri)).toBe(`${cycloneConfiguration({})},${uri}`);
  });
});
