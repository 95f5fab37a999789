/**
 * A source, the planner, the limit from reports, and a stand-in for the released bridge, in virtual time. However slow
 * a source is beside the rate that was declared for it, a free link carries all its points.
 */

import { ReleasedFrames } from '@farpoint/conformance/testing';
import { someOf } from '@farpoint/network-sim/cases';
import {
  decodeBandwidth,
  FULL_POINT_PACKET_BYTES,
  POINTS_PER_PACKET,
  writePointPacketHeader,
} from '@farpoint/protocol';
import { BitRate, EvenPace } from '@farpoint/timing';
import { describe, expect, it } from 'vitest';
import { FramePlanner, type PlanPolicy } from '../../sense/encode/plan.ts';
import { SourceRate } from '../../sense/sources/source-rate.ts';
import { ReportedLimit } from './reported-limit.ts';

const POINTS = 9000;
const RTP_HEADER_BYTES = 20;
const OVERHEAD_BYTES = 64;
const MOST_BITS_PER_SECOND = 60e6;
const ONE_WAY_MS = 20;
const FREE = 1e9;
const NARROW = 1.5e6;
/** What waits before the link when it is full. */
const QUEUE_MS = 500;

interface Scenario {
  comesPerSecond: number;
  declaredPerSecond: number;
  /** At a time, ms. */
  linkBitsPerSecond: (nowMs: number) => number;
  policy: PlanPolicy;
  seconds: number;
}

interface Frame {
  atMs: number;
  points: number;
}

/** @returns the frames that were sent, and those that reached the bridge */
function run({ comesPerSecond, declaredPerSecond, linkBitsPerSecond, policy, seconds }: Scenario): {
  sent: Frame[];
  arrived: Frame[];
} {
  const planner = new FramePlanner({
    ...{ policy, mostFramesPerSecond: declaredPerSecond, anyRate: false },
    ...{ floorFraction: 0.1, mostPoints: 1e6 },
  });
  const rate = new SourceRate();
  const pace = new EvenPace();
  const limit = new ReportedLimit(FULL_POINT_PACKET_BYTES + OVERHEAD_BYTES);
  const sent: Frame[] = [];
  const arrived: Frame[] = [];
  /** Reports on their way to the robot. */
  const reports: { atMs: number; bitsPerSecond: number }[] = [];
  let arrivalMs = 0;
  const bridge = new ReleasedFrames({
    onReport: (report) =>
      reports.push({ atMs: arrivalMs + ONE_WAY_MS, bitsPerSecond: decodeBandwidth(report) }),
    onFrame: (frame) => arrived.push({ atMs: arrivalMs, points: frame.length / 8 }),
  });
  const packet = new Uint8Array(RTP_HEADER_BYTES + FULL_POINT_PACKET_BYTES);
  const view = new DataView(packet.buffer, RTP_HEADER_BYTES);
  let plannedMs = 1000 / declaredPerSecond;
  let linkFreeMs = 0;
  let frameNumber = 0;
  for (let cloud = 0; cloud < seconds * comesPerSecond; cloud++) {
    // Up to a tenth of the interval early or late.
    const nowMs = ((cloud + 1 + (((cloud * 7919) % 21) - 10) / 100) * 1000) / comesPerSecond;
    rate.came(nowMs);
    while ((reports[0]?.atMs ?? Number.POSITIVE_INFINITY) <= nowMs)
      limit.reported((reports.shift() as { bitsPerSecond: number }).bitsPerSecond);
    if (!pace.takes(nowMs, plannedMs)) continue;
    const plan = planner.plan({
      targetBitsPerSecond: Math.min(limit.bitsPerSecond, MOST_BITS_PER_SECOND),
      ...{ rawPoints: POINTS, overheadBytes: OVERHEAD_BYTES, probeBytes: 0, workMs: 3 },
      measuredFramesPerSecond: rate.perSecond,
    });
    plannedMs = 1000 / plan.framesPerSecond;
    pace.taken(nowMs, plannedMs);
    const packets = plan.points / POINTS_PER_PACKET;
    const packetMs = BitRate.msFor(linkBitsPerSecond(nowMs), FULL_POINT_PACKET_BYTES + OVERHEAD_BYTES);
    for (let i = 0; i < packets; i++) {
      writePointPacketHeader(view, 0, {
        ...{ frameNumber, frameLength: packets * 1200, sequenceOffset: i * 1200, sequenceLength: 1200 },
      });
      linkFreeMs = Math.max(linkFreeMs, nowMs);
      if (linkFreeMs > nowMs + QUEUE_MS) continue;
      linkFreeMs += packetMs;
      arrivalMs = linkFreeMs + ONE_WAY_MS;
      bridge.accept(packet, true, arrivalMs);
    }
    limit.sent(packets, nowMs);
    sent.push({ atMs: nowMs, points: plan.points });
    frameNumber++;
  }
  return { sent, arrived };
}

const between = (frames: readonly Frame[], fromS: number, toS: number) =>
  frames.filter(({ atMs }) => atMs >= fromS * 1000 && atMs < toS * 1000);
const pointsOf = (frames: readonly Frame[]) => frames.reduce((sum, { points }) => sum + points, 0);

const rates = [5, 10, 15, 18, 30].flatMap((comesPerSecond) =>
  [10, 18, 30].flatMap((declaredPerSecond) =>
    (['latency', 'paper'] as const).map((policy) => ({ comesPerSecond, declaredPerSecond, policy })),
  ),
);

describe('a source beside the released bridge', () => {
  it.each(someOf(rates))(
    'loses no points on a free link: $comesPerSecond come, $declaredPerSecond declared, $policy',
    (at) => {
      const { arrived } = run({ ...at, linkBitsPerSecond: () => FREE, seconds: 25 });
      const last = between(arrived, 15, 24);
      const perSecond = Math.min(at.comesPerSecond, at.declaredPerSecond);
      expect(pointsOf(last)).toBeGreaterThanOrEqual(0.95 * 9 * perSecond * POINTS);
      expect(Math.min(...last.map(({ points }) => points))).toBeGreaterThanOrEqual(0.95 * POINTS);
    },
  );

  it.each(someOf(rates, 1))(
    'is limited by a narrow link: $comesPerSecond come, $declaredPerSecond declared, $policy',
    (at) => {
      const { sent, arrived } = run({ ...at, linkBitsPerSecond: () => NARROW, seconds: 40 });
      const carried = (NARROW * 1200) / (FULL_POINT_PACKET_BYTES + OVERHEAD_BYTES) / 64;
      const perSecond = (frames: readonly Frame[]) => pointsOf(between(frames, 20, 39)) / 19;
      expect(perSecond(arrived)).toBeGreaterThan(0.75 * carried);
      // Reports that jitter do not tell the rate exactly, and the limit tries whether more is possible.
      expect(perSecond(sent)).toBeLessThan(1.3 * carried);
    },
  );

  it('gets its points back when a narrow link widens', () => {
    const at = { comesPerSecond: 10, declaredPerSecond: 30, policy: 'latency' } as const;
    const { arrived } = run({
      ...at,
      linkBitsPerSecond: (nowMs) => (nowMs < 20_000 ? NARROW : FREE),
      seconds: 50,
    });
    const perFrame = (fromS: number, toS: number) =>
      pointsOf(between(arrived, fromS, toS)) / (toS - fromS) / 10;
    expect(perFrame(10, 20)).toBeLessThan(0.4 * POINTS);
    expect(perFrame(40, 49)).toBeGreaterThan(0.99 * POINTS);
  });
});
