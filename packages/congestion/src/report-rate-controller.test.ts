import { someOf } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { ReportRateController } from './report-rate-controller.ts';
import {
  losses,
  type Outcome,
  queueQuantiles,
  runScenario,
  type Scenario,
  utilisation,
} from './testing/index.ts';

const M = 1e6;
const LINK = 41.44 * M;
const flat = (bitsPerSecond: number) => [{ atMs: 0, mbps: bitsPerSecond / M }];
/** RFC 3550 spreads reports over 0.5 to 1.5 of their interval. */
const RTCP = [{ reports: true, probes: false, feedbackMs: [500, 1500] as const }];

function run(scenario: Partial<Scenario>): Outcome {
  return runScenario(
    {
      ...{ name: 'test', durationMs: 60_000, capacity: flat(LINK), rttMs: 42.4, queueMs: 100, media: RTCP },
      ...scenario,
    },
    () => new ReportRateController(),
  );
}

const used = (outcome: Outcome, fromMs: number, toMs: number) =>
  utilisation(outcome, outcome.media[0]!, fromMs, toMs);
const median = (outcome: Outcome, fromMs: number, toMs: number) =>
  queueQuantiles(outcome.media[0]!, fromMs, toMs, [0.5])[0]!;

describe('with one report per second', () => {
  test.each<[string, Partial<Scenario>, number]>([
    ...someOf([1, 2, 3]).map((seed): [string, Partial<Scenario>, number] => [`(seed ${seed})`, { seed }, 30]),
    ['at a third of the start rate', { capacity: flat(M) }, 40],
  ])('finds a steady link %s and mostly uses it, its queue mostly short', (_, scenario, queueMs) => {
    const outcome = run(scenario);
    expect(used(outcome, 20_000, 60_000)).toBeGreaterThan(0.85);
    expect(median(outcome, 20_000, 60_000)).toBeLessThan(queueMs);
    expect(losses(outcome.media[0]!, 20_000, 60_000).overflow).toBeLessThan(0.02);
  });

  test('does not fill a queue of one second', () => {
    const outcome = run({ capacity: flat(8 * M), queueMs: 1000 });
    expect(used(outcome, 20_000, 60_000)).toBeGreaterThan(0.85);
    expect(queueQuantiles(outcome.media[0]!, 20_000, 60_000, [0.95])[0]).toBeLessThan(150);
  });

  test.each([0.05, 0.2])('tolerates loss of %f that has nothing to do with load', (loss) => {
    const outcome = run({ loss });
    expect(used(outcome, 20_000, 60_000)).toBeGreaterThan(0.6 * (1 - loss));
  });

  test('follows a link that falls to a fifth within seconds, and uses it again afterwards', () => {
    const outcome = run({
      capacity: [...flat(LINK), { atMs: 20_000, mbps: 8 }, { atMs: 40_000, mbps: LINK / M }],
    });
    expect(median(outcome, 25_000, 40_000)).toBeLessThan(40);
    expect(losses(outcome.media[0]!, 25_000, 40_000).overflow).toBeLessThan(0.03);
    expect(used(outcome, 40_000, 60_000)).toBeGreaterThan(0.4);
  });
});

describe('ReportRateController', () => {
  const send = (controller: ReportRateController, nowMs: number) => controller.onPacketSent(0, 1200, nowMs);

  test('sends little if nobody reports, and a trickle if reports stop', () => {
    const controller = new ReportRateController();
    for (let ms = 0; ms < 2500; ms += 25) {
      send(controller, ms);
      controller.update(ms);
    }
    expect(controller.snapshot(2500)).toMatchObject({ state: 'no-reports', estimateBitsPerSecond: 500_000 });
    controller.onReceiverReport({ packetsReceived: 50, packetsLost: 0 }, 2500);
    expect(controller.snapshot(2500).state).toBe('reports');
    for (let ms = 2525; ms < 9000; ms += 25) {
      send(controller, ms);
      controller.update(ms);
    }
    expect(controller.snapshot(9000)).toMatchObject({ state: 'silent', estimateBitsPerSecond: 150_000 });
    controller.onReceiverReport({ packetsReceived: 60, packetsLost: 0 }, 9000);
    expect(controller.snapshot(9000)).toMatchObject({ state: 'reports', estimateBitsPerSecond: 250_000 });
  });

  test('grows by 40 % a second until the path has shown its limit, then by 12 %, and by 4 % near the limit', () => {
    const controller = new ReportRateController();
    const estimate = () => controller.snapshot(0).estimateBitsPerSecond;
    let [ms, packetsReceived] = [0, 0];
    send(controller, ms);
    /** All that was sent in the last second has arrived. @returns the factor by which the rate has changed */
    const second = (rttMs: number) => {
      const before = estimate();
      packetsReceived += before / (8 * 1200);
      ms += 1000;
      controller.onReceiverReport({ packetsReceived, packetsLost: 0, rttMs }, ms);
      return estimate() / before;
    };
    second(40);
    const factors = [40, 40, 40, 140, 40, 40, 40].map(second);
    expect(factors).toEqual([1.4, 1.4, 1.4, 0.85, 1.12, 1.04, 1.04].map((each) => expect.closeTo(each, 6)));
  });

  test('does not take a pause of its own for silence of the receiver', () => {
    const controller = new ReportRateController();
    send(controller, 0);
    controller.onReceiverReport({ packetsReceived: 1, packetsLost: 0 }, 10);
    for (let ms = 25; ms < 20_000; ms += 25) controller.update(ms);
    send(controller, 20_000);
    controller.update(20_025);
    expect(controller.snapshot(20_025).state).toBe('reports');
  });

  test('obeys the receiver’s limit', () => {
    const controller = new ReportRateController();
    controller.onReceiverLimit(400_000, 0);
    expect(controller.targetBitsPerSecond(0)).toBe(400_000);
  });

  test('restarts with the sums of another counter, and no report takes the rate out of its bounds', () => {
    const reports = fc.array(
      fc.record({
        packetsReceived: fc.nat(1e6),
        packetsLost: fc.integer({ min: -1e6, max: 1e6 }),
        source: fc.constantFrom('rtcp' as const, 'application' as const),
        rttMs: fc.option(fc.double({ min: -10, max: 1e5, noNaN: true })),
      }),
      { maxLength: 40 },
    );
    fc.assert(
      fc.property(reports, (all) => {
        const controller = new ReportRateController({ maxBitsPerSecond: 50e6 });
        let ms = 0;
        for (const report of all) {
          ms += 300;
          send(controller, ms);
          controller.onReceiverReport(report, ms);
          controller.update(ms);
          const target = controller.targetBitsPerSecond(ms);
          expect(target).toBeGreaterThanOrEqual(150_000);
          expect(target).toBeLessThanOrEqual(50e6);
        }
      }),
      { seed: 12 },
    );
  });
});
