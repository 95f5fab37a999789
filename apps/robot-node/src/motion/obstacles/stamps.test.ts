/**
 * Time from outside is judged: whatever the stamps of clouds, poses and fixes say, the robot comes no nearer to a wall and no
 * farther out of its fence than with honest ones and what is stated here. A sensor whose clouds are all older than the guard
 * remembers is none: then, as towards all that no sensor sees, the robot is slow.
 */
import { casesOf, longProperty, shareInEachRun, someOf } from '@farpoint/network-sim/cases';
import { defaultObstacleGuardOptions } from '@farpoint/safety';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { FOREIGN_AGE_MS } from '../../ground/ros/capture-time.ts';
import {
  CLOUD,
  cloudAt,
  FIX,
  fixAt,
  headerAt,
  mountTransform,
  ODOMETRY,
  odometryAt,
  POSE,
  poseAt,
  rosWall,
  TF,
  transformAt,
} from '../../testing/ros-wall-source.ts';
import { driveAtWall, type WallTruth } from '../../testing/wall-drive.ts';

const MOUNT = { x: 0.1, y: 0, z: 0.9, roll: 0, pitch: 0.3, yaw: 0 };
const SPEED = 0.6;
/** Each case is eight seconds of clouds. */
const share = shareInEachRun(1 / 12);
const shareOfFixes = shareInEachRun(1 / 6);
const { occupiedMemoryMs, unseenMps } = defaultObstacleGuardOptions;
/** What clocks in step may differ by, at full speed. */
const AHEAD_M = 0.1 * SPEED;
/** How far the robot goes before a pose that does not move is given up, and until it stands. */
const FROZEN_M = 0.1 + 0.55 * SPEED + SPEED ** 2 / 2 + 0.1;

type Header = ReturnType<typeof headerAt>;
type Stamps = (nowMs: number) => Header['stamp'] | null;
/** How old its messages were by their stamps when they came, at least and at most, ms. */
type Publisher = Stamps & { leastAgeMs: number; mostAgeMs: number };

/** One way in which a publisher stamps; `null`: as it should. */
const ways = {
  honest: fc.constant((nowMs: number) => nowMs),
  ahead: fc.constantFrom(50, 150, 1000, 86_400_000).map((by) => (nowMs: number) => nowMs + by),
  behind: fc
    .constantFrom(200, 450, 700, 2000, 5000, 60_000, 3_600_000, 1.6e12)
    .map((by) => (nowMs: number) => nowMs - by),
  repeated: fc.constant((_: number, last: number) => last),
  missing: fc.constant(() => null),
  steps: fc.constantFrom(-60_000, -1500, -300, 300, 60_000).map((by) => {
    let offset = 0;
    let count = 0;
    return (nowMs: number) => {
      if (++count % 10 === 0) offset += by;
      return nowMs + offset;
    };
  }),
};
type Way = (nowMs: number, last: number) => number | null;
/** A publisher that goes from one way to another, every so many messages. */
const publisher = fc
  .array(
    fc.tuple(fc.integer({ min: 1, max: 60 }), fc.oneof(...(Object.values(ways) as fc.Arbitrary<Way>[]))),
    {
      minLength: 1,
      maxLength: 4,
    },
  )
  .map((phases): Publisher => {
    let [phase, left, last] = [0, phases[0]?.[0] ?? 0, 5000];
    const stamps: Publisher = Object.assign(
      (nowMs: number) => {
        if (left-- <= 0) {
          phase = (phase + 1) % phases.length;
          left = phases[phase]?.[0] ?? 0;
        }
        const way = phases[phase]?.[1] as Way;
        const ms = way(nowMs, last);
        const ageMs = nowMs - (ms ?? nowMs);
        stamps.leastAgeMs = Math.min(stamps.leastAgeMs, ageMs);
        stamps.mostAgeMs = Math.max(stamps.mostAgeMs, ageMs);
        if (ms === null) return { sec: 0, nanosec: 0 };
        last = ms;
        return headerAt(ms, '').stamp;
      },
      { leastAgeMs: Number.POSITIVE_INFINITY, mostAgeMs: Number.NEGATIVE_INFINITY },
    );
    return stamps;
  });

const stamped = <Message extends { header: Header }>(
  message: Message,
  stamp: Header['stamp'] | null,
): Message => (stamp === null ? message : { ...message, header: { ...message.header, stamp } });

interface Run {
  clouds?: Stamps;
  poses?: Stamps;
  /** Of a satellite receiver, which then says where the robot is in its fence. */
  fixes?: Stamps;
  /** What the receiver says of a robot that has gone so far, m; default: the truth. */
  fixOf?: (x: number) => number;
  by?: 'odometry' | 'tf' | 'pose';
  fenceM?: number;
  wallM?: number;
  /** How late clouds and poses come, with honest stamps, ms. */
  lateMs?: { clouds?: number; poses?: number };
  seconds?: number;
}

describe('a robot', async () => {
  const codec = await loadCodecFromDisk();

  async function drive(run: Run) {
    const { clouds, poses, fixes, fixOf = (x) => x, by = 'odometry', lateMs = {}, ...rest } = run;
    const fixTopic = fixes === undefined ? undefined : '/fix';
    const topics = {
      odometry: { topic: '/odom', as: 'pose' },
      tf: { topic: '/tf', as: 'tf' },
      pose: { topic: '/pose', as: 'pose', type: POSE },
    };
    const wall = await rosWall(
      [{ topic: '/points', as: 'cloud' }, topics[by], { topic: '/fix', as: 'fix' }],
      MOUNT,
    );
    const { source, graph, setNow, faults } = wall;
    const waiting: { kind: 'cloud' | 'pose'; truth: WallTruth }[] = [];
    const driven = driveAtWall(codec, {
      ...{ mount: MOUNT, source, setNow, speed: SPEED, odometry: true, fixTopic, ...rest },
      feed: (truth) => {
        waiting.push({ kind: 'pose', truth }, { kind: 'cloud', truth });
        const due = ({ kind, truth: { nowMs } }: (typeof waiting)[number]) =>
          nowMs <= truth.nowMs - ((kind === 'cloud' ? lateMs.clouds : lateMs.poses) ?? 0);
        const comes = waiting.filter(due);
        waiting.splice(0, waiting.length, ...waiting.filter((each) => !due(each)));
        for (const { kind, truth: then } of comes) {
          const { nowMs, x, points, base } = then;
          if (kind === 'pose' && fixes !== undefined)
            graph.say('/fix', FIX, stamped(fixAt(nowMs, fixOf(x)), fixes(nowMs)));
          if (kind === 'cloud')
            graph.say('/points', CLOUD, stamped(cloudAt(nowMs, points), clouds?.(nowMs) ?? null));
          else if (by === 'odometry')
            graph.say('/odom', ODOMETRY, stamped(odometryAt(nowMs, x, then), poses?.(nowMs) ?? null));
          else if (by === 'pose') graph.say('/pose', POSE, stamped(poseAt(nowMs, x), poses?.(nowMs) ?? null));
          else {
            const odom = stamped(transformAt(nowMs, 'odom', 'base_link', base), poses?.(nowMs) ?? null);
            // A joint that goes on, whatever becomes of odometry.
            const joint = { ...mountTransform(MOUNT, 'arm'), header: headerAt(nowMs, 'base_link') };
            graph.say('/tf', TF, { transforms: [odom, joint] });
          }
        }
      },
    });
    source.close();
    return { ...driven, faults };
  }

  it.each(someOf([450, 700, 2000], 3))(
    'whose clouds come %i ms late stops before the wall, slower',
    async (clouds) => {
      const { contactMps, fastestMps } = await drive({ lateMs: { clouds }, seconds: 8 });
      expect(contactMps).toBeNull();
      expect(fastestMps).toBeLessThan(0.31);
    },
  );

  it.each(someOf([700, 2000, 5000], 2))(
    'whose odometry comes %i ms late stands, where it has a fence',
    async (poses) => {
      const { outsideM, fastestMps } = await drive({ lateMs: { poses }, fenceM: 5, wallM: 20, seconds: 8 });
      expect([outsideM < 0, fastestMps]).toEqual([true, 0]);
    },
  );

  it('with honest stamps goes up to its fence, and not out of it', async () => {
    const { outsideM, fastestMps } = await drive({ fenceM: 2, wallM: 20, seconds: 8 });
    expect(fastestMps).toBeGreaterThan(0.5);
    expect(outsideM).toBeLessThan(0);
    expect(outsideM).toBeGreaterThan(-0.3);
  });

  it.each(['odometry', 'tf', 'pose'] as const)(
    'comes to no wall and out of no fence, whatever the stamps say (%s)',
    async (by) => {
      let metres = 0;
      await fc.assert(
        fc.asyncProperty(publisher, publisher, async (clouds, poses) => {
          const atWall = await drive({ by, clouds, poses, seconds: 8 });
          // What was seen longer ago than that is remembered no more, as if there were no sensor: the robot is slow. Of another
          // clock's stamps the age is not known: with them the robot may see the wall, and then is not slow.
          const isSlow = atWall.fastestMps <= unseenMps + 1e-9;
          const isOld = clouds.leastAgeMs > occupiedMemoryMs;
          if (isOld && clouds.mostAgeMs < FOREIGN_AGE_MS) expect(isSlow).toBe(true);
          else if (!isOld || !isSlow) expect(atWall.contactMps).toBeNull();
          metres += 1.5 - atWall.gapM;
        }),
        longProperty(36, 12, { share }),
      );
      // Without this check, the property would hold for a robot that never moves.
      expect(metres / casesOf(12, share)).toBeGreaterThan(0.3);
      await fc.assert(
        fc.asyncProperty(publisher, async (poses) => {
          const { outsideM } = await drive({ by, poses, fenceM: 1.5, wallM: 30, seconds: 8 });
          expect(outsideM).toBeLessThan(AHEAD_M + FROZEN_M);
        }),
        longProperty(37, 12, { share }),
      );
    },
    120_000,
  );

  it('comes out of no fence, whatever the stamps of its satellite receiver say', async () => {
    let metres = 0;
    await fc.assert(
      fc.asyncProperty(publisher, async (fixes) => {
        const { outsideM, fastestMps } = await drive({ fixes, fenceM: 2, wallM: 30, seconds: 8 });
        expect(outsideM).toBeLessThan(AHEAD_M + 0.1);
        metres += fastestMps > 0 ? 1 : 0;
      }),
      longProperty(38, 24, { share: shareOfFixes }),
    );
    expect(metres).toBeGreaterThan(casesOf(24, shareOfFixes) / 4);
  }, 60_000);

  it('whose satellite receiver holds still, with stamps that go on, is given up', async () => {
    const honest: Stamps = (nowMs) => headerAt(nowMs, '').stamp;
    const moves = await drive({ fixes: honest, fenceM: 2, wallM: 30, seconds: 8 });
    expect([moves.outsideM < 0.1, moves.fastestMps > 0.5]).toEqual([true, true]);
    const held = await drive({
      fixes: honest,
      fixOf: (x) => Math.min(x, 0.3),
      fenceM: 1.5,
      wallM: 30,
      seconds: 20,
    });
    // A metre behind odometry after the last half metre in which it moved, half of that after each pause, and the way to stand.
    expect(held.outsideM).toBeLessThan(0.3 + 1 + 0.5 + 0.25 + 0.4 + 0.25 - 1.5);
  });

  it('whose pose does not move, with stamps that do, is given up', async () => {
    for (const by of ['odometry', 'pose'] as const) {
      const wall = await rosWall(
        [
          { topic: '/points', as: 'cloud' },
          by === 'odometry' ? { topic: '/odom', as: 'pose' } : { topic: '/pose', as: 'pose', type: POSE },
        ],
        MOUNT,
      );
      const { source, graph, setNow } = wall;
      const { outsideM } = driveAtWall(codec, {
        ...{ mount: MOUNT, source, setNow, odometry: true, fenceM: 1, wallM: 30, seconds: 8 },
        feed: (truth) => {
          if (by === 'odometry') graph.say('/odom', ODOMETRY, odometryAt(truth.nowMs, 0, truth));
          else graph.say('/pose', POSE, poseAt(truth.nowMs, 0));
          graph.say('/points', CLOUD, cloudAt(truth.nowMs, truth.points));
        },
      });
      source.close();
      expect(outsideM).toBeLessThan(FROZEN_M + 0.25 - 1);
    }
  });
});
