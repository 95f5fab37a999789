import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type CodedPlan, FramePlanner, type PlanInput, type PlanOptions, wireBytesOfPacket } from './plan.ts';

const OPTIONS: PlanOptions = {
  policy: 'latency',
  mostFramesPerSecond: 60,
  anyRate: false,
  floorFraction: 0.1,
  mostPoints: 1e6,
};
const INPUT: PlanInput = {
  targetBitsPerSecond: 40e6,
  rawPoints: 230_400,
  overheadBytes: 68,
  probeBytes: 0,
  workMs: 5,
};
const planner = (options: Partial<PlanOptions> = {}) => new FramePlanner({ ...OPTIONS, ...options });
const wireBitsPerSecond = (points: number, framesPerSecond: number) =>
  (points / 150) * wireBytesOfPacket(68) * 8 * framesPerSecond;

describe('FramePlanner, as the paper', () => {
  const paper = () => planner({ policy: 'paper', mostFramesPerSecond: 30 });

  it('fills the rate on the wire with whole packets, and no more', () => {
    const { points, framesPerSecond } = paper().plan(INPUT);
    expect(framesPerSecond).toBe(30);
    expect(points % 150).toBe(0);
    expect(wireBitsPerSecond(points, 30)).toBeLessThanOrEqual(40e6);
    expect(wireBitsPerSecond(points + 150, 30)).toBeGreaterThan(40e6);
  });

  it('sends no more than the cloud has, and no more than is allowed', () => {
    expect(paper().plan({ ...INPUT, rawPoints: 1000 }).points).toBe(900);
    expect(planner({ policy: 'paper', mostFramesPerSecond: 30, mostPoints: 10_000 }).plan(INPUT).points).toBe(
      9900,
    );
  });

  it('keeps the floor of 10 % of the raw cloud per second', () => {
    // 23,040 points per second, 768 per frame: five packets.
    expect(paper().plan({ ...INPUT, targetBitsPerSecond: 0 }).points).toBe(750);
  });
});

describe('FramePlanner, for latency', () => {
  it('takes every frame of the source if the link carries it', () => {
    const { points, framesPerSecond } = planner().plan(INPUT);
    expect(framesPerSecond).toBe(60);
    expect(wireBitsPerSecond(points, 60)).toBeLessThanOrEqual(40e6);
    expect(wireBitsPerSecond(points + 150, 60)).toBeGreaterThan(40e6);
  });

  it('sends fewer frames rather than frames of too few points, but at least 10 a second', () => {
    const at = (mbps: number) =>
      planner().plan({ ...INPUT, targetBitsPerSecond: mbps * 1e6 }).framesPerSecond;
    expect([20, 8, 5, 4, 1, 0].map(at)).toEqual([60, 30, 20, 15, 10, 10]);
    expect(
      planner({ mostFramesPerSecond: 5 }).plan({ ...INPUT, targetBitsPerSecond: 0 }).framesPerSecond,
    ).toBe(5);
  });

  it('sends one packet per frame if the rate is zero', () => {
    expect(planner().plan({ ...INPUT, targetBitsPerSecond: 0 }).points).toBe(150);
  });

  it('does not alternate between two frame rates', () => {
    const plan = planner();
    const rates = [14, 12, 14, 12, 14, 18, 14].map(
      (mbps) => plan.plan({ ...INPUT, targetBitsPerSecond: mbps * 1e6 }).framesPerSecond,
    );
    expect(rates).toEqual([60, 30, 30, 30, 30, 60, 60]);
  });

  it('leaves the capture thread spare time', () => {
    expect(planner().plan({ ...INPUT, workMs: 20 }).framesPerSecond).toBe(30);
    expect(planner().plan({ ...INPUT, workMs: 200 }).framesPerSecond).toBe(10);
  });

  it('asks a source without a fixed rate as often as the thread has time', () => {
    const at = (workMs: number) => planner({ anyRate: true }).plan({ ...INPUT, workMs }).framesPerSecond;
    expect(at(5)).toBe(60);
    expect(at(10)).toBeCloseTo(46);
    expect(at(20)).toBeCloseTo(23);
    // More than there is time for is not planned: the frames would be too small for the link.
    expect(at(200)).toBe(5);
    const coded = planner({ anyRate: true }).planCoded('organised', { ...INPUT, workMs: 10 });
    expect(coded.framesPerSecond).toBeCloseTo(46);
    expect(coded.framesPerSecond * coded.budgetBytes * 8).toBeLessThan(INPUT.targetBitsPerSecond);
  });

  it('returns to a high rate when there is room for as many frames as there is time for', () => {
    /** The bit rate at which it does, Mbit/s. */
    const returnsAt = (workMs: number) => {
      const plan = planner({ anyRate: true });
      const at = (mbps: number) =>
        plan.planCoded('organised', { ...INPUT, targetBitsPerSecond: mbps * 1e6, workMs }).framesPerSecond;
      return Array.from({ length: 600 }, (_, i) => (i + 1) / 10).find((mbps) => at(mbps) > 30) ?? Number.NaN;
    };
    expect(returnsAt(10) / returnsAt(5)).toBeCloseTo(46 / 60, 2);
  });

  it('makes a frame large enough for the requested probe train', () => {
    const small = { ...INPUT, targetBitsPerSecond: 2e6 };
    const plain = planner().plan(small).points;
    const probing = planner().plan({ ...small, probeBytes: 40_000 }).points;
    expect(plain).toBeLessThan(3200);
    expect((probing / 150) * wireBytesOfPacket(68)).toBeGreaterThanOrEqual(40_000);
    // … but not without limit.
    expect(planner().plan({ ...small, probeBytes: 1e9 }).points).toBeLessThanOrEqual(8 * 3200);
    expect(planner({ mostPoints: 600 }).plan({ ...small, probeBytes: 40_000 }).points).toBe(600);
  });

  it('never plans more than the rate, except one packet per frame', () => {
    const numbers = fc.record({
      targetBitsPerSecond: fc.integer({ min: 0, max: 300_000_000 }),
      rawPoints: fc.integer({ min: 0, max: 400_000 }),
      workMs: fc.double({ min: 0, max: 100, noNaN: true }),
      mostFramesPerSecond: fc.integer({ min: 1, max: 120 }),
      anyRate: fc.boolean(),
    });
    fc.assert(
      fc.property(numbers, ({ mostFramesPerSecond, anyRate, ...input }) => {
        const { points, framesPerSecond } = planner({ mostFramesPerSecond, anyRate }).plan({
          ...INPUT,
          ...input,
        });
        expect(points % 150).toBe(0);
        expect(framesPerSecond).toBeGreaterThanOrEqual(Math.min(10, mostFramesPerSecond));
        expect(framesPerSecond).toBeLessThanOrEqual(mostFramesPerSecond);
        if (points > 150) {
          expect(wireBitsPerSecond(points, framesPerSecond)).toBeLessThanOrEqual(input.targetBitsPerSecond);
        }
      }),
    );
  });
});

describe('FramePlanner, for a source that is slower than declared', () => {
  const at = (measured: number | null, options: Partial<PlanOptions> = {}, input: Partial<PlanInput> = {}) =>
    planner({ mostFramesPerSecond: 18, ...options }).plan({
      ...{ ...INPUT, ...input },
      measuredFramesPerSecond: measured,
    });

  it.each(['latency', 'paper'] as const)(
    'shares the rate among the frames that come, policy %s',
    (policy) => {
      const { points, framesPerSecond } = at(10, { policy });
      expect(framesPerSecond).toBe(10);
      expect(wireBitsPerSecond(points, 10)).toBeGreaterThan(0.99 * INPUT.targetBitsPerSecond);
      expect(wireBitsPerSecond(points, 10)).toBeLessThanOrEqual(INPUT.targetBitsPerSecond);
    },
  );

  it('makes coded frames as fine as the frames that come may be', () => {
    const budget = (measuredFramesPerSecond: number | null) =>
      planner({ mostFramesPerSecond: 18 }).planCoded('organised', {
        ...{ ...INPUT, targetBitsPerSecond: 5e6 },
        measuredFramesPerSecond,
      }).budgetBytes;
    expect(budget(10) / budget(null)).toBeCloseTo(1.8, 2);
  });

  it('expects no more than was declared, and takes what is nearly that for it', () => {
    expect([40, 18.4, 17.3, null].map((measured) => at(measured).framesPerSecond)).toEqual([18, 18, 18, 18]);
    expect(at(17).framesPerSecond).toBe(17);
  });

  it('leaves out frames of a measured rate as of a declared one, to 10 a second', () => {
    const few = { targetBitsPerSecond: 3e6 };
    expect(at(19.8, { mostFramesPerSecond: 30 }, few).framesPerSecond).toBeCloseTo(9.9);
    expect(at(10, { mostFramesPerSecond: 30 }, few).framesPerSecond).toBe(10);
    expect(at(5, { mostFramesPerSecond: 30 }, few).framesPerSecond).toBe(5);
  });

  it('stays with every frame although the measured rate varies', () => {
    const plan = planner({ mostFramesPerSecond: 60 });
    const rates = [20, 20.8, 19.5, 21, 20.2].map((measuredFramesPerSecond) => {
      const input = { ...INPUT, targetBitsPerSecond: 4.8e6, measuredFramesPerSecond };
      return plan.plan(input).framesPerSecond / measuredFramesPerSecond;
    });
    expect(rates).toEqual([1, 1, 1, 1, 1]);
  });

  it('claims no more of the path than the frames that come can use', () => {
    const useful = (measuredFramesPerSecond: number | null) =>
      planner({ mostFramesPerSecond: 18 }).usefulBitsPerSecond('points64', {
        ...INPUT,
        measuredFramesPerSecond,
      });
    expect(useful(9) / useful(null)).toBeCloseTo(0.5);
  });
});

describe('FramePlanner, coded', () => {
  const dataBits = ({ framesPerSecond, budgetBytes }: CodedPlan) => framesPerSecond * budgetBytes * 8;

  it('sends whole frames, prefers finer to more frequent ones, and none finer than can be seen', () => {
    const at = (mbps: number, workMs = 5) =>
      planner().planCoded('organised', { ...INPUT, targetBitsPerSecond: mbps * 1e6, workMs });
    const most = { framesPerSecond: 60, budgetBytes: Math.floor((230_400 * 2.4) / 8), limited: false };
    expect(at(100)).toEqual(most);
    expect(at(8).framesPerSecond).toBe(15);
    // The rest of the rate is less than a frame's share of it.
    expect(dataBits(at(8))).toBeGreaterThan(7e6);
    expect(dataBits(at(8))).toBeLessThan(8e6);
    expect(at(1).framesPerSecond).toBe(10);
    expect(at(100, 20).framesPerSecond).toBe(30);
  });

  it('while somebody drives, makes a frame finer than a camera only where it is sent within 10 ms all the same', () => {
    const at = (mbps: number, prompt = true) =>
      planner().planCoded('organised', { ...INPUT, targetBitsPerSecond: mbps * 1e6, prompt });
    const bitsAt = (mbps: number) => (at(mbps).budgetBytes * 8) / 230_400;
    expect([38, 41.44, 45].map(bitsAt)).toEqual([2, 2, 2]);
    const dataShare = MAX_POINT_DATA_BYTES / wireBytesOfPacket(INPUT.overheadBytes);
    expect(at(56).budgetBytes).toBe(Math.floor((56e6 * dataShare) / 8 / 100));
    expect(bitsAt(70)).toBeCloseTo(2.4, 3);
    expect([14, 41.44, 56, 70].map((mbps) => at(mbps).limited)).toEqual([true, false, false, false]);
    expect((at(45, false).budgetBytes * 8) / 230_400).toBeCloseTo(2.4, 3);
  });

  it('gives more bits to clouds without a grid', () => {
    const input = { ...INPUT, rawPoints: 60_000, targetBitsPerSecond: 20e6 };
    const { framesPerSecond, budgetBytes } = planner({ mostFramesPerSecond: 10 }).planCoded(
      'unorganised',
      input,
    );
    expect(framesPerSecond).toBe(10);
    expect((budgetBytes * 8) / 60_000).toBeGreaterThan(30);
  });

  it('never plans more than the rate, except one packet per frame, and makes room for a probe', () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 0, max: 300_000_000 }),
        fc.integer({ min: 0, max: 400_000 }),
        fc.constantFrom('organised' as const, 'unorganised' as const),
        (targetBitsPerSecond, rawPoints, format) => {
          const plan = planner().planCoded(format, { ...INPUT, targetBitsPerSecond, rawPoints });
          expect(plan.budgetBytes).toBeGreaterThanOrEqual(1200);
          if (plan.budgetBytes > 1200) expect(dataBits(plan)).toBeLessThanOrEqual(targetBitsPerSecond);
        },
      ),
    );
    const probing = { ...INPUT, targetBitsPerSecond: 1e6, probeBytes: 20_000 };
    expect(planner().planCoded('organised', probing).budgetBytes).toBeGreaterThan(17_000);
  });

  it('carries a whole probe train even if the frame is as small as its budget allows', () => {
    // A link's rate that a frame of the finest quality does not fill.
    const probing = { ...INPUT, targetBitsPerSecond: 28e6, probeBytes: 79_000 };
    const { budgetBytes } = planner().planCoded('organised', probing);
    const packets = (0.955 * budgetBytes) / MAX_POINT_DATA_BYTES;
    expect(packets * wireBytesOfPacket(INPUT.overheadBytes)).toBeGreaterThanOrEqual(probing.probeBytes);
  });
});

describe('FramePlanner, for a computer that draws less than the link carries', () => {
  const display = { framesPerSecond: 13, points: 9000 };
  const input = { ...INPUT, display };

  it('plans no more frames a second, and no more points where they are a sample', () => {
    for (const policy of ['latency', 'paper'] as const) {
      const { framesPerSecond, points } = planner({ policy, anyRate: true }).plan(input);
      expect([framesPerSecond, points]).toEqual([13, 9000]);
    }
    expect(planner({ anyRate: true }).planCoded('organised', input).framesPerSecond).toBe(13);
    expect(planner({ anyRate: true }).planCoded('unorganised', input).budgetBytes).toBe((9000 * 64) / 8);
  });

  it('takes a whole fraction of a camera’s own rate', () => {
    expect(planner().plan(input).framesPerSecond).toBe(12);
    expect(planner().plan({ ...INPUT, display: { ...display, framesPerSecond: 29 } }).framesPerSecond).toBe(
      30,
    );
    expect(
      planner().plan({ ...INPUT, display: { ...display, framesPerSecond: 1 } }).framesPerSecond,
    ).toBeLessThanOrEqual(1.1);
  });

  it('wants no more of the link than it can use', () => {
    const all = planner().usefulBitsPerSecond('points64', INPUT);
    expect(planner().usefulBitsPerSecond('points64', input)).toBeCloseTo(
      (all * 13 * 9000) / (60 * 230_400),
      -3,
    );
    expect(planner().usefulBitsPerSecond('organised', input)).toBeCloseTo(
      (planner().usefulBitsPerSecond('organised', INPUT) * 13) / 60,
    );
  });

  it('a link that carries less still decides', () => {
    const poor = { ...input, targetBitsPerSecond: 1e6 };
    expect(planner().plan(poor)).toEqual(
      planner().plan({ ...INPUT, targetBitsPerSecond: 1e6, display: undefined }),
    );
  });
});
