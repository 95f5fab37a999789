import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { parseSignalingUrl, parseStored, readSettings } from './settings.ts';

const served = { protocol: 'https:', hostname: 'x.org', host: 'x.org:8443', isDevServer: false };
const dev = { protocol: 'http:', hostname: 'localhost', host: 'localhost:5173', isDevServer: true };
const read = (query: string, stored = {}, page = served) =>
  readSettings(new URLSearchParams(query), stored, page);

describe('readSettings', () => {
  test('the service that serves the page, or port 3000 beside a development server', () => {
    expect(read('').signalingUrl).toBe('wss://x.org:8443/operator');
    expect(read('', {}, dev).signalingUrl).toBe('ws://localhost:3000/operator');
  });

  test('the address goes before what is stored, which goes before the default', () => {
    const stored = { signaling: 'wss://stored.org', token: 's', name: 'Stored' };
    expect(read('', stored)).toMatchObject({
      signalingUrl: 'wss://stored.org/operator',
      token: 's',
      name: 'Stored',
    });
    expect(read('signaling=wss://asked.org/p&token=a&name=Asked', stored)).toMatchObject({
      signalingUrl: 'wss://asked.org/p',
      token: 'a',
      name: 'Asked',
    });
  });

  test('a bad address is told, and the default used', () => {
    const settings = read('signaling=ftp://x');
    expect(settings.signalingFault).toContain('no WebSocket address');
    expect(settings.signalingUrl).toBe('wss://x.org:8443/operator');
  });

  test('robot ids and canvas sizes that cannot be are left out', () => {
    expect(read('robot=sim-1&canvas=640x360')).toMatchObject({
      robot: 'sim-1',
      canvas: { width: 640, height: 360 },
    });
    for (const canvas of ['640', '0x0', '99999x5', '64x64x64', '-1x50']) {
      expect(read(`canvas=${canvas}`).canvas).toBe(null);
    }
    expect(read('robot=NOT%20ONE').robot).toBe(null);
  });
});

describe('parseSignalingUrl', () => {
  test('accepts what people type', () => {
    expect(parseSignalingUrl('x.org', true)).toEqual({ url: 'wss://x.org/operator' });
    expect(parseSignalingUrl('x.org:3000', false)).toEqual({ url: 'ws://x.org:3000/operator' });
    expect(parseSignalingUrl('https://x.org/', true)).toEqual({ url: 'wss://x.org/operator' });
    expect(parseSignalingUrl('ws://127.0.0.1:3000', true)).toEqual({ url: 'ws://127.0.0.1:3000/operator' });
  });

  test('says why an unsafe address cannot be used', () => {
    expect(parseSignalingUrl('ws://x.org', true)).toEqual({
      fault: 'a page served by https can only use a wss: signaling address',
    });
  });

  test('never throws', () => {
    fc.assert(
      fc.property(fc.string(), fc.boolean(), (text, secure) => {
        parseSignalingUrl(text, secure);
      }),
      { seed: 1 },
    );
  });
});

test('parseStored takes only what is of the right kind', () => {
  expect(parseStored(null)).toEqual({});
  expect(parseStored('not json')).toEqual({});
  expect(parseStored('[1]')).toEqual({});
  expect(parseStored('{"token":5,"name":"A","pointScale":99}')).toEqual({ name: 'A', pointScale: 4 });
  fc.assert(
    fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
      parseStored(text);
    }),
    { seed: 2 },
  );
});
