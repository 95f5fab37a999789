import { zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { CollisionDemand } from './collision-demand.ts';

function go(linear: number, angular = 0) {
  const twist = zeroTwist();
  [twist.linear.x, twist.angular.z] = [linear, angular];
  return twist;
}

const demand = (silentMps = 0) => new CollisionDemand({ silentMs: 500, silentMps, reachM: 0.5 });
const FREE = { factor: 1, reason: null, urgent: false };

describe('what another program demands', () => {
  test('bounds the motion while it holds, and no longer', () => {
    const other = demand();
    other.hear(Number.POSITIVE_INFINITY, 1000);
    expect([other.bound(go(1), 1010), other.state(1010)]).toEqual([FREE, 'free']);
    other.hear(0.25, 1020);
    expect(other.bound(go(1), 1030)).toEqual({ factor: 0.25, reason: 'collision-topic', urgent: false });
    // A turn is as fast as its outline.
    expect(other.bound(go(0, -1), 1030).factor).toBe(0.5);
    expect(other.bound(go(-0.2), 1030)).toEqual(FREE);
    other.hear(0, 1040);
    expect(other.bound(go(0.1), 1050)).toEqual({ factor: 0, reason: 'collision-topic', urgent: true });
    // Also for a robot that is still on its way to standing.
    expect([other.bound(go(0), 1050).urgent, other.state(1050)]).toEqual([true, 'bounded']);
    other.hear(Number.POSITIVE_INFINITY, 1060);
    expect(other.bound(go(1), 1070)).toEqual(FREE);
  });

  test('stops, or slows, when it is silent: before the first message, and when the program is gone', () => {
    for (const silentMps of [0, 0.3]) {
      const other = demand(silentMps);
      const bounded = { factor: silentMps, reason: 'collision-silent', urgent: silentMps === 0 };
      expect(other.bound(go(1), 0)).toEqual(bounded);
      other.hear(Number.POSITIVE_INFINITY, 1000);
      expect(other.bound(go(1), 1500)).toEqual(FREE);
      expect(other.bound(go(1), 1501)).toEqual(bounded);
      other.hear(Number.POSITIVE_INFINITY, 1510);
      other.lose();
      expect([other.bound(go(1), 1511), other.state(1511)]).toEqual([bounded, 'silent']);
    }
  });

  test('whatever is heard: the robot is never faster than the newest demand, nor moves when silent', () => {
    const any = fc.double();
    const event = fc.record({ most: any, atMs: fc.integer({ min: 0, max: 2000 }) });
    const wish = fc.tuple(any, any);
    fc.assert(
      fc.property(fc.array(event), wish, fc.integer({ min: 0, max: 3000 }), (events, [v, w], nowMs) => {
        const other = demand();
        let newest: (typeof events)[number] | null = null;
        for (const each of events) {
          other.hear(each.most, each.atMs);
          if (newest === null || each.atMs >= newest.atMs) newest = each;
        }
        const { factor, reason, urgent } = other.bound(go(v, w), nowMs);
        expect(factor >= 0 && factor <= 1).toBe(true);
        expect(reason === null).toBe(factor === 1);
        expect(urgent).toBe(factor === 0);
        const silent = newest === null || nowMs - newest.atMs > 500;
        const most = silent ? 0 : Math.max(0, newest?.most || 0);
        const pace = Math.max(Math.abs(v), Math.abs(w) * 0.5);
        if (Number.isFinite(pace)) expect(pace * factor).toBeLessThanOrEqual(most * (1 + 1e-12));
        else if (most < Number.POSITIVE_INFINITY) expect(factor).toBe(0);
      }),
      { seed: 31 },
    );
  });
});
