import { describe, expect, test } from 'vitest';
import { JANUS_HELP, readJanusOptions } from './janus-options.ts';

describe('the options of pnpm janus', () => {
  test('listen on loopback unless told otherwise', () => {
    expect(readJanusOptions([])).toEqual({
      verbose: false,
      server: {
        ...{ host: '127.0.0.1', port: 8188, publicAddress: null },
        ...{ robotPorts: [20_000, 20_199], viewerPorts: [20_200, 20_999] },
      },
    });
  });

  test('reach the server', () => {
    const argv = ['--host', '0.0.0.0', '--port=9000', '--public-address', '203.0.113.7', '--admin-key', 'k'];
    const more = [
      '--robot-ports',
      '30000-30099',
      '--tls-cert',
      'c.pem',
      '--tls-key',
      'k.pem',
      '--folder',
      '/x',
    ];
    expect(readJanusOptions([...argv, ...more])?.server).toEqual({
      ...{ host: '0.0.0.0', port: 9000, publicAddress: '203.0.113.7', adminKey: 'k', folder: '/x' },
      ...{ robotPorts: [30_000, 30_099], viewerPorts: [20_200, 20_999] },
      ...{ certificate: { certificate: 'c.pem', key: 'k.pem' } },
    });
  });

  test.each([
    [['--hots', 'x'], '--hots is not an option (did you mean --host?)'],
    [['--host', 'localhost'], '--host must be an IP address of this machine'],
    [['--port', '70000'], '--port must be a port from 1 to 65535, not "70000"'],
    [['--robot-ports', '9-5'], '--robot-ports must be two ports, the lower first, e.g. 20000-20199'],
    [['--tls-key', 'k.pem'], '--tls-cert and --tls-key belong together'],
    [['--verbose=1'], '--verbose takes no value'],
    [['7'], '"7" does not belong to an option'],
  ])('%j: %s', (argv, sentence) => {
    expect(() => readJanusOptions(argv)).toThrow(sentence);
  });

  test('are explained', () => {
    expect(readJanusOptions(['--help'])).toBe(null);
    expect(JANUS_HELP).toContain('--public-address');
  });
});
