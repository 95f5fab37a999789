import type { TimedBaseState } from '@farpoint/cloud-source';
import { type Twist, zeroTwist } from '@farpoint/protocol';
import { defaultGeofenceOptions, EarthFrame } from '@farpoint/safety';
import { describe, expect, test } from 'vitest';
import { BaseOdometry } from '../../sense/base/base-odometry.ts';
import { openGeofence } from './open-geofence.ts';

const fence = { allowed: [], forbidden: [], slow: [], radiusM: 3 };
const options = { fence, fix: null, errorM: 0, limits: defaultGeofenceOptions };
const FACING_BACK = { x: 0, y: 0, z: 1, w: 0 };

function state(x: number, more: Partial<TimedBaseState> = {}): TimedBaseState {
  const pose = { position: { x, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
  return { pose, twist: zeroTwist(), battery: null, contact: false, timeMs: 1000, ...more };
}
const ahead: Twist = { linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } };

describe('by odometry', () => {
  const factor = (known: TimedBaseState | null, isSimulated = true, nowMs = 1010) =>
    openGeofence(options, () => known, isSimulated).geofence.bound(ahead, nowMs).factor;

  test('a simulated base says where it is, and where it looks', () => {
    expect(factor(state(0))).toBe(1);
    expect(factor(state(2.48))).toBe(0);
    const turned = { ...state(2.4).pose, orientation: FACING_BACK };
    expect(factor(state(2.4, { pose: turned }))).toBe(1);
    expect(factor(state(0), true, 1501)).toBe(0);
    expect(factor(null)).toBe(0);
  });

  test('another base must say when it was there', () => {
    expect(factor(state(0), false)).toBe(0);
    expect(factor(state(0, { measuredMs: null }), false)).toBe(0);
    expect(factor(state(0, { measuredMs: 990 }), false)).toBe(1);
    expect(factor(state(0, { measuredMs: 400 }), false)).toBe(0);
  });

  test('a velocity that nobody measures is the one that the wheels were told', () => {
    const odometry = new BaseOdometry({ maxLinear: 1, maxAngular: 1 }, false);
    odometry.take(state(1.8, { measuredMs: 1000, twist: null }));
    const { geofence } = openGeofence(options, () => odometry.believed, false);
    expect(geofence.bound(zeroTwist(), 1010).factor).toBe(1);
    odometry.told({ ...zeroTwist(), linear: { x: 1, y: 0, z: 0 } }, 1000);
    expect(geofence.bound(zeroTwist(), 1010)).toMatchObject({ factor: 0, urgent: true });
  });
});

test.each([
  [true, 0],
  [false, 1],
])('a base that moves sideways (%s) is judged by its velocity to the side', (movesSideways, factor) => {
  const twist: Twist = { ...zeroTwist(), linear: { x: 0, y: 1, z: 0 } };
  const pose = { ...state(0).pose, position: { x: 0, y: 1.9, z: 0 } };
  const { geofence } = openGeofence(options, () => state(0, { pose, twist }), true, movesSideways);
  expect(geofence.bound(zeroTwist(), 1010).factor).toBe(factor);
});

describe('by satellites', () => {
  const earth = new EarthFrame({ latitude: 48, longitude: 11, turnDeg: 0 });
  const open = () => openGeofence({ ...options, fix: { topic: '/fix', earth } }, () => state(99), true);

  test('only the receiver’s newest position counts, and no direction is assumed', () => {
    const { geofence, fix } = open();
    const bound = () => geofence.bound(ahead, 1010);
    expect(bound()).toEqual({ factor: 0, reason: 'fence', urgent: true });
    fix?.take({ topic: '/other', numbers: [48, 11] }, 1000);
    expect(bound().factor).toBe(0);
    fix?.take({ topic: '/fix', numbers: [48, 11, null] }, 1000);
    expect(bound().factor).toBe(1);
    // 2.2 m east, looking anywhere.
    fix?.take({ topic: '/fix', numbers: [48, 11 + 2.2 / 74_600, null] }, 1000);
    expect(bound()).toMatchObject({ reason: 'fence-near' });
    fix?.take({ topic: '/fix', numbers: [null, null, null] }, 1000);
    expect(bound().factor).toBe(0);
    fix?.take({ topic: '/fix', numbers: [48, 11, null] }, 400);
    expect(bound().factor).toBe(0);
  });

  test('a position counts as old as it is, and not at all where nobody can tell', () => {
    const { geofence, fix } = open();
    const factor = () => geofence.bound(ahead, 1010).factor;
    fix?.take({ topic: '/fix', numbers: [48, 11, null], measuredMs: null }, 1000);
    expect(factor()).toBe(0);
    fix?.take({ topic: '/fix', numbers: [48, 11, null], measuredMs: 400 }, 1000);
    expect(factor()).toBe(0);
    fix?.take({ topic: '/fix', numbers: [48, 11, null], measuredMs: 900 }, 1000);
    expect(factor()).toBe(1);
    // One that was overtaken.
    fix?.take({ topic: '/fix', numbers: [48, 11 + 9, null], measuredMs: 800 }, 1005);
    expect(factor()).toBe(1);
  });
});
