import { describe, expect, test } from 'vitest';
import { ConnectError, type ConnectOptions, checkConnectOptions, connect } from './connect.ts';

const good = { signaling: 'wss://x.org', robot: 'rover-1' };
const failure = (options: ConnectOptions, act: (options: ConnectOptions) => unknown): ConnectError => {
  try {
    act(options);
  } catch (error) {
    if (error instanceof ConnectError) return error;
    throw error;
  }
  throw new Error('did not throw');
};
const check = (options: ConnectOptions) => checkConnectOptions(options, true);

describe('connect', () => {
  test('fills in defaults', () => {
    expect(check(good)).toEqual({
      signalingUrl: 'wss://x.org/operator',
      robot: 'rover-1',
      token: undefined,
      name: 'Operator',
      icePolicy: 'all',
      cloudFormats: undefined,
      credentials: undefined,
      knownRobots: undefined,
    });
  });

  test('names an option that cannot be used', () => {
    expect(failure({ ...good, signaling: 'ftp://x' }, check)).toMatchObject({
      reason: 'bad-signaling-address',
      message: expect.stringContaining('ftp://x'),
    });
    expect(failure({ ...good, signaling: 'ws://x.org' }, check).reason).toBe('bad-signaling-address');
    expect(failure({ ...good, robot: 'a robot!' }, check).reason).toBe('bad-robot-id');
    expect(failure({ ...good, token: '' }, check).reason).toBe('bad-token');
    const plain = { signaling: 'ws://x.org', token: 'a-token' };
    expect(failure(plain, (options) => checkConnectOptions(options, false)).reason).toBe('token-unprotected');
    expect(checkConnectOptions({ ...plain, signaling: 'ws://127.0.0.1:3000' }, false).token).toBe('a-token');
    expect(failure({ ...good, ticket: 'farpoint-ticket.e30' }, check).reason).toBe('bad-ticket');
    expect(failure({ ...good, name: '' }, check).reason).toBe('bad-name');
  });

  test('reports missing WebRTC', () => {
    expect(failure(good, connect).reason).toBe('no-webrtc');
  });
});
