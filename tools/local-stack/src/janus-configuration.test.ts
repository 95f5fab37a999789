import { describe, expect, test } from 'vitest';
import { type JanusConfigurationOptions, janusConfiguration } from './janus-configuration.ts';

const options: JanusConfigurationOptions = {
  host: '127.0.0.1',
  port: 8188,
  publicAddress: null,
  robotPorts: [20_000, 20_100],
  viewerPorts: [21_000, 21_999],
  adminKey: 'a "key" with \\',
  certificate: null,
  pluginsFolder: '/tmp/x/plugins',
  transportsFolder: '/tmp/x/transports',
};

const file = (name: string, changed: Partial<JanusConfigurationOptions> = {}) =>
  janusConfiguration({ ...options, ...changed }).get(name) ?? '';

describe('the configuration of Janus', () => {
  test('listens on the given address only, unencrypted without a certificate', () => {
    const text = file('janus.transport.websockets.jcfg');
    expect(text).toContain('ws = true');
    expect(text).toContain('ws_ip = "127.0.0.1"');
    expect(text).toContain('ws_port = 8188');
    expect(text).toContain('wss = false');
    expect(text).not.toContain('cert_pem');
  });

  test('is encrypted with a certificate', () => {
    const certificate = { certificate: '/c.pem', key: '/k.pem' };
    const text = file('janus.transport.websockets.jcfg', { certificate });
    expect(text).toContain('ws = false');
    expect(text).toContain('wss_port = 8188');
    expect(text).toContain('cert_key = "/k.pem"');
  });

  test('asks for the admin key, whatever characters it has', () => {
    expect(file('janus.plugin.streaming.jcfg')).toContain('admin_key = "a \\"key\\" with \\\\"');
  });

  test('names the public address only where there is one', () => {
    expect(file('janus.jcfg')).not.toContain('nat_1_1_mapping');
    expect(file('janus.jcfg', { publicAddress: '203.0.113.7' })).toContain('nat_1_1_mapping = "203.0.113.7"');
  });
});
