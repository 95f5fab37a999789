/** Where the time of frames and commands goes: joined with the robot's times, and never a number that nobody has measured. */
import { type CommandTimes, type FrameTimes, stampUsOf } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { CommandStages } from './command-stages.ts';
import { FrameLatency } from './frame-latency.ts';
import { FrameStages, frameStages } from './frame-stages.ts';
import { STAGES_KEPT_MS } from './stage-window.ts';

/** The robot's clock is so far ahead of the page's, ms. */
const AHEAD_MS = 5_000_000;
const age = (stampUs: number, nowMs: number) => {
  const behind = (stampUsOf(nowMs + AHEAD_MS) - stampUs) | 0;
  return behind / 1000;
};
/** A frame's times. @param captureMs the page's clock */
const timesOf = (frame: number, captureMs: number, ...us: number[]): FrameTimes =>
  [0, frame, stampUsOf(captureMs + AHEAD_MS), ...us] as unknown as FrameTimes;

/** A frame that was captured at 1000 ms and is shown at 1100 ms. */
function shown(stages: FrameStages, ageOf: (stampUs: number, nowMs: number) => number | null = age) {
  const latency = new FrameLatency(ageOf, stages);
  const captureUs = stampUsOf(1000 + AHEAD_MS);
  latency.onPacket(7, captureUs, 150, 300, 1060, 1070);
  latency.onPacket(7, captureUs, 150, 300, 1075, 1081);
  latency.onDrawn(1100);
  return latency;
}
const times = timesOf(7, 1000, 4000, 12_000, 13_000, 20_000);
const all = { capture: 4, encode: 8, queue: 8, link: 55, decode: 6, draw: 19 };

describe('FrameStages', () => {
  test('what is neither the robot’s time nor the page’s is the link’s, and all together are the frame’s latency', () => {
    const stages = new FrameStages();
    const latency = shown(stages);
    const [row] = stages.window.rows(1100);
    expect(row).toMatchObject({ number: 7, endedMs: 1100, totalMs: 100, told: false });
    expect(row?.stages).toEqual({ ...all, capture: null, encode: null, queue: null, link: null });
    stages.onTimes(times);
    expect(stages.window.rows(1200)[0]).toMatchObject({ told: true, stages: all });
    expect(latency.distribution?.max).toBe(100);
    expect(stages.window.summary(1200)).toMatchObject({ rows: 1, untold: 0, clockless: 0, worst: 'link' });
  });

  test('the robot’s times may come before the frame is shown', () => {
    const stages = new FrameStages();
    stages.onTimes(timesOf(6, 967, 1, 2, 3, 4));
    stages.onTimes(times);
    shown(stages);
    expect(stages.window.rows(1100)[0]).toMatchObject({ told: true, stages: all });
  });

  test('while the robot’s clock is unknown, the link and the total are, and nothing else', () => {
    const stages = new FrameStages();
    shown(stages, () => null);
    stages.onTimes(times);
    expect(stages.window.rows(1100)[0]).toMatchObject({ totalMs: null, stages: { ...all, link: null } });
    expect(stages.window.summary(1100)).toMatchObject({ clockless: 1, totalMs: null, worst: 'draw' });
    expect(stages.window.summary(1100).stages.link).toBe(null);
  });

  test('frames of which the robot says nothing are counted, once it should have', () => {
    const stages = new FrameStages();
    shown(stages);
    expect(stages.window.summary(6000).untold).toBe(0);
    expect(stages.window.summary(6101).untold).toBe(1);
    expect(stages.window.summary(6101, 1000)).toMatchObject({
      rows: 0,
      untold: 1,
      totalMs: null,
      worst: null,
    });
    // Another frame of this number, of an earlier run of the robot.
    stages.onTimes(timesOf(7, 999, 1, 2, 3, 4));
    expect(stages.window.summary(6101).untold).toBe(1);
  });

  test('keeps 30 s', () => {
    const stages = new FrameStages();
    for (let i = 0; i < 5000; i++) stages.onShown(i, 0, 1, i, i, i * 20);
    const nowMs = 4999 * 20;
    const rows = stages.window.rows(nowMs);
    expect(rows.map(({ number }) => number)).toEqual(
      Array.from({ length: STAGES_KEPT_MS / 20 + 1 }, (_, i) => 4999 - STAGES_KEPT_MS / 20 + i),
    );
    for (let i = 0; i < 5000; i++) stages.onShown(i, 0, 1, nowMs, nowMs, nowMs);
    expect(stages.window.rows(nowMs)).toHaveLength(2048);
  });

  test('whatever is lost, late or twice, the stages of a told row add up to what FrameLatency measures', () => {
    const ms = fc.double({ min: 0, max: 400, noNaN: true });
    const event = fc.record({
      frame: fc.integer({ min: 0, max: 12 }),
      points: fc.integer({ min: 1, max: 300 }),
      waits: fc.tuple(ms, ms, ms),
      us: fc.array(fc.integer({ min: 0, max: 400_000 }), { minLength: 4, maxLength: 4 }),
      told: fc.constantFrom('before', 'after', 'twice', 'never'),
      draws: fc.boolean(),
    });
    fc.assert(
      fc.property(fc.array(event, { maxLength: 60 }), (events) => {
        const stages = new FrameStages();
        const measured: number[] = [];
        const latency = new FrameLatency(age, {
          onShown: (...shownFrame) => {
            measured.push(shownFrame[2] as number);
            stages.onShown(...shownFrame);
          },
        });
        let nowMs = 1000;
        for (const { frame, points, waits, us, told, draws } of events) {
          const captureMs = 1000 + frame * 33;
          const sorted = us.sort((a, b) => a - b);
          const tell = () => stages.onTimes(timesOf(frame, captureMs, ...sorted));
          if (told === 'before' || told === 'twice') tell();
          const [toPage, toGpu, toScreen] = waits;
          nowMs += toPage + toGpu;
          latency.onPacket(frame, stampUsOf(captureMs + AHEAD_MS), points, 300, nowMs - toGpu, nowMs);
          nowMs += toScreen;
          if (draws) latency.onDrawn(nowMs);
          if (told === 'after' || told === 'twice') tell();
        }
        const rows = stages.window.rows(nowMs);
        expect(rows.map(({ totalMs }) => totalMs)).toEqual(measured.slice(-rows.length));
        for (const row of rows) {
          const parts = frameStages.map((stage) => row.stages[stage]);
          expect(parts.includes(null)).toBe(!row.told);
          if (row.told)
            expect(parts.reduce<number>((sum, part) => sum + (part ?? 0), 0)).toBeCloseTo(
              row.totalMs as number,
              6,
            );
        }
      }),
      { seed: 22 },
    );
  });
});

describe('CommandStages', () => {
  const command: CommandTimes = [17, stampUsOf(1042 + AHEAD_MS), 500, 2500];

  test('from the hand to the drive', () => {
    const stages = new CommandStages(age);
    stages.onSent(17, 980, 995, 1000);
    expect(stages.window.rows(1000)[0]).toMatchObject({ told: false, totalMs: null });
    stages.onTimes(command, 1300);
    const [row] = stages.window.rows(1300);
    expect(row?.stages).toEqual({ hand: 15, page: 5, link: 42, gate: 0.5, wheels: 2 });
    expect(row?.totalMs).toBeCloseTo(64.5, 6);
    expect(stages.window.summary(1300).worst).toBe('link');
  });

  test('a refused command has no time to the wheels, and one that nobody knows is ignored', () => {
    const stages = new CommandStages(age);
    stages.onSent(17, 980, 995, 1000);
    stages.onTimes([17, command[1], 500, null], 1300);
    stages.onTimes([18, command[1], 500, 600], 1300);
    const rows = stages.window.rows(1300);
    expect(rows).toHaveLength(1);
    expect(rows[0]).toMatchObject({ totalMs: null, stages: { link: 42, gate: 0.5, wheels: null } });
    expect(stages.refused).toBe(1);
    stages.clear();
    expect([stages.refused, stages.window.rows(1300)]).toEqual([0, []]);
  });

  test('while the robot’s clock is unknown, so is the link', () => {
    const stages = new CommandStages(() => null);
    stages.onSent(17, 980, 995, 1000);
    stages.onTimes(command, 1300);
    const summary = stages.window.summary(1300);
    expect([summary.clockless, summary.stages.link, summary.worst]).toEqual([1, null, 'hand']);
  });
});
