import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { NO_BENCH } from './bench-settings.ts';
import { ownSignalingUrl, parseStored, readSettings } from './settings.ts';

const served = { protocol: 'https:', hostname: 'x.org', host: 'x.org:8443', isDevServer: false };
const dev = { protocol: 'http:', hostname: 'localhost', host: 'localhost:5173', isDevServer: true };
const read = (query: string, stored = {}, page = served) =>
  readSettings(new URLSearchParams(query), stored, page);

describe('readSettings', () => {
  test('defaults to the service that serves the page, or to port 3000 beside a development server', () => {
    expect(read('').signalingUrl).toBe('wss://x.org:8443/operator');
    expect(read('', {}, dev).signalingUrl).toBe('ws://localhost:3000/operator');
  });

  test('prefers the page address to the stored settings, and these to the defaults', () => {
    const stored = {
      signaling: 'wss://stored.org',
      tokens: new Map([['wss://stored.org', 's']]),
      name: 'Stored',
    };
    expect(read('', stored)).toMatchObject({
      signalingUrl: 'wss://stored.org/operator',
      token: 's',
      name: 'Stored',
    });
    expect(read('signaling=wss://asked.org/p&token=a&name=Asked', stored)).toMatchObject({
      signalingUrl: 'wss://asked.org/p/operator',
      token: 'a',
      name: 'Asked',
    });
  });

  test('sends a token over wss: only, or within this machine', () => {
    const plain = { protocol: 'http:', hostname: '10.0.0.5', host: '10.0.0.5:3000', isDevServer: false };
    expect(read('token=a', {}, plain)).toMatchObject({
      token: undefined,
      signalingFault: { reason: 'insecure-token' },
    });
    expect(read('', {}, plain).signalingFault).toBeNull();
    expect(read('token=a', {}, dev).token).toBe('a');
  });

  test('prefers a token that came in an earlier address of this tab to a stored one', () => {
    const origin = 'wss://x.org:8443';
    const stored = { tokens: new Map([[origin, 's']]), visitTokens: new Map([[origin, 'v']]) };
    expect(read('', stored).token).toBe('v');
    expect(read('token=a', stored).token).toBe('a');
    expect(read('signaling=wss://other.org', stored).token).toBeUndefined();
  });

  test('reports a bad signaling address and uses the default', () => {
    const settings = read('signaling=ftp://x');
    expect(settings.signalingFault).toEqual({ reason: 'not-websocket', address: 'ftp://x' });
    expect(settings.signalingUrl).toBe('wss://x.org:8443/operator');
  });

  test('leads the view by the commands unless the page address says otherwise', () => {
    expect(read('').predict).toBe(true);
    expect(read('predict=0').predict).toBe(false);
    expect(read('predict=perhaps').predict).toBe(true);
  });

  test('presents videos in step unless the stored settings say otherwise', () => {
    expect(read('').synchronised).toBe(true);
    expect(read('', { synchronised: false }).synchronised).toBe(false);
    expect(parseStored('{"synchronised":false}', 'wss://x.org').synchronised).toBe(false);
    expect(parseStored('{"synchronised":"no"}', 'wss://x.org').synchronised).toBeUndefined();
  });

  test('gives cues unless it is told not to', () => {
    expect([read('').cues, read('', { cues: false }).cues]).toEqual([true, false]);
  });

  test('keeps clips only where it is told to', () => {
    expect([read('').clips, read('', { clips: true }).clips]).toEqual([false, true]);
    expect(parseStored('{"clips":true}', 'wss://x.org').clips).toBe(true);
    expect(parseStored('{"clips":"yes"}', 'wss://x.org').clips).toBeUndefined();
  });

  test('an address makes the page neither small nor slow', () => {
    expect(read('canvas=320x180&measure=1&every=8&barcode=1')).toMatchObject(NO_BENCH);
  });

  test('ignores invalid robot ids', () => {
    expect(read('robot=sim-1').robot).toBe('sim-1');
    expect(read('robot=NOT%20ONE').robot).toBe(null);
  });
});

describe('a token is sent only to the service that it was given for', () => {
  const tokens = new Map([
    ['wss://x.org:8443', 'own'],
    ['wss://stored.org', 'stored'],
  ]);

  test.each([
    ['', 'own'],
    ['signaling=wss://x.org:8443/elsewhere', 'own'],
    ['signaling=wss://elsewhere.org', undefined],
    ['signaling=wss://x.org', undefined],
    ['signaling=wss://x.org.elsewhere.org:8443', undefined],
    ['signaling=wss://stored.org', 'stored'],
    // The token belongs to the service that comes with it.
    ['signaling=wss://elsewhere.org&token=theirs', 'theirs'],
    ['token=given', 'given'],
    // The address beside the token is invalid, so it is unknown which service the token is for.
    ['signaling=ftp://elsewhere.org&token=theirs', 'own'],
  ])('?%s', (query, token) => {
    expect(read(query, { tokens }).token).toBe(token);
  });

  test('does not use a token from the page’s link for a service chosen in the settings', () => {
    const stored = { signaling: 'wss://stored.org', tokens };
    expect(read('token=given', stored).token).toBe('stored');
    expect(read('', stored).token).toBe('stored');
  });

  test('assigns the single token of earlier versions to the page’s own service', () => {
    const stored = parseStored('{"token":"old","signaling":""}', ownSignalingUrl(served));
    expect(read('', stored).token).toBe('old');
    expect(read('signaling=wss://elsewhere.org', stored).token).toBeUndefined();
    const newer = '{"token":"old","tokens":{"wss://x.org:8443":"new"}}';
    expect(read('', parseStored(newer, ownSignalingUrl(served))).token).toBe('new');
  });
});

test('parseStored accepts only values of the right type', () => {
  const own = ownSignalingUrl(served);
  const nothing = { tokens: new Map() };
  expect(parseStored(null, own)).toEqual(nothing);
  expect(parseStored('not json', own)).toEqual({});
  expect(parseStored('[1]', own)).toEqual(nothing);
  expect(parseStored('{"token":5,"name":"A","pointScale":99}', own)).toEqual({
    ...nothing,
    name: 'A',
    pointScale: 4,
  });
  fc.assert(
    fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
      parseStored(text, own);
    }),
    { seed: 2 },
  );
});
