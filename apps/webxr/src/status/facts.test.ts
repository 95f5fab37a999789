import type { Telemetry } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { sessionFacts } from './facts.ts';
import type { PageStats } from './page-stats.ts';
import { wristLines } from './wrist-lines.ts';

const figures = {
  ...{ pointsPerFrame: 12_345.6, framesPerSecond: 10, bitsPerSecond: 3_210_000, lossRate: 0 },
  ...{ drawnOneOf: 1, remembered: null, minRttMs: 42, frameLatencyMs: null, mtpMs: null },
} as PageStats;
const telemetry = {
  drive: 'idle',
  operators: 1,
  twist: { linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0.25 } },
  battery: { voltage: 24.04, percentage: 0.2 },
} as Telemetry;
const open = { type: 'estop', latched: false } as const;
const session = {
  heard: true,
  name: 'Rover',
  telemetry,
  estop: open,
  afterGap: 'let-go',
  maxLinear: 1,
  readings: [],
  figures,
} as const;
const values = (facts: ReturnType<typeof sessionFacts>) =>
  Object.fromEntries(facts.map(({ name, value }) => [name, value]));

describe('the table of figures', () => {
  test('says whether the view is a prediction, beside what the robot reports', () => {
    const seen = { ...figures, view: { state: 'predicted', aheadMs: 142 } } as const;
    expect(values(sessionFacts({ ...session, figures: seen })).View).toBe('Predicted 140 ms ahead');
    expect(values(sessionFacts({ ...session, figures: seen, telemetry: null })).View).toBeUndefined();
  });

  test('says how old what is remembered may be', () => {
    const of = (oldestS: number) =>
      values(sessionFacts({ ...session, figures: { ...figures, remembered: { points: 5, oldestS } } }))
        .Remembered;
    expect(of(0)).toBe('up to 10 s old');
    expect(of(41)).toBe('up to 50 s old');
    expect(of(181)).toBe('up to 4 min old');
    expect(of(7300)).toBe('up to 3 h old');
    expect(of(90_000)).toBe('a day old or more');
    expect('Remembered' in values(sessionFacts(session))).toBe(false);
  });

  test('lists what is known, in order', () => {
    expect(values(sessionFacts(session))).toEqual({
      Robot: 'Rover',
      State: 'Stationary',
      Speed: '0.50 m/s  -0.25 rad/s',
      Battery: '20 %  24.0 V',
      Points: '12,346 × 10/s',
      Rate: '3.2 Mbit/s',
      Loss: '0.0 %',
      'Round trip': '42 ms',
      'Frame age': '–',
    });
    const bare = sessionFacts({ ...session, name: null, telemetry: null });
    expect(bare.map(({ name }) => name)).toEqual(['Points', 'Rate', 'Loss', 'Round trip', 'Frame age']);
  });

  test.each([
    [1, '260 ms (1 test)'],
    [2, 'median 260 ms (2 tests)'],
    // Of 19, the 95th percentile by nearest rank is the slowest.
    [19, 'median 260 ms (19 tests)'],
    [20, 'median 260 ms  p95 300 ms (20 tests)'],
  ])('after %i latency tests, no more is claimed than they show', (count, words) => {
    const mtpMs = { count, p50: 260, p95: 300, p99: 310, max: 320 };
    const facts = sessionFacts({ ...session, figures: { ...figures, mtpMs } as PageStats });
    expect(facts.find(({ name }) => name === 'Motion to photon')?.value).toBe(words);
  });

  test('without a word from the robot, no figure claims to be live', () => {
    const seen = {
      ...figures,
      mtpMs: { count: 30, p50: 90, p95: 120 },
      remembered: { points: 5, oldestS: 3 },
    } as PageStats;
    const unheard = sessionFacts({ ...session, figures: seen, heard: false });
    expect(unheard.map(({ name }) => name)).toEqual(
      sessionFacts({ ...session, figures: seen }).map(({ name }) => name),
    );
    expect(unheard.filter(({ value }) => value !== '–').map(({ name }) => name)).toEqual([
      'Robot',
      'Remembered',
      'Motion to photon',
    ]);
    expect(unheard.every(({ tone }) => tone === undefined)).toBe(true);
    // What says how old it is does not claim to be live.
    const readings = [
      { topic: '/plan', label: 'Path', text: '5 m, 3 s old: not drawn', tone: 'warning', tellsAge: true },
      { topic: '/t', label: 'Motor', text: '40 °C', tone: 'neutral' },
    ] as const;
    const aged = values(sessionFacts({ ...session, readings, heard: false }));
    expect([aged.Path, aged.Motor]).toEqual(['5 m, 3 s old: not drawn', '–']);
  });

  test('says what a slow computer leaves out', () => {
    const slow = { ...figures, pointsPerFrame: 210_040, drawnOneOf: 8 };
    expect(values(sessionFacts({ ...session, figures: slow })).Drawn).toBe(
      '26,300 of 210,000: this computer is slow',
    );
    const few = { ...figures, pointsPerFrame: 600, drawnOneOf: 8 };
    expect(values(sessionFacts({ ...session, figures: few })).Drawn).toBe('80 of 600: this computer is slow');
  });

  test('shows an emergency stop before telemetry does, and who pressed it', () => {
    const facts = sessionFacts({ ...session, estop: { ...open, latched: true, by: 'robot' } });
    expect(values(facts).State).toBe('Emergency stop (by robot)');
    const held = { ...open, latched: true, by: 'robot', releasedAt: 'robot' } as const;
    expect(values(sessionFacts({ ...session, estop: held })).State).toBe(
      'Emergency stop (by robot; released at the robot only)',
    );
  });

  test('after a gap, says what the robot waits for', () => {
    const stopped = { ...session, telemetry: { ...telemetry, drive: 'watchdog' } as Telemetry };
    const state = (afterGap: 'resume' | 'let-go') => values(sessionFacts({ ...stopped, afterGap })).State;
    expect(state('resume')).toBe('Stopped: no recent command');
    expect(state('let-go')).toBe('Stopped by a gap: let go, then drive');
  });

  test('a reading replaces the battery row and no other', () => {
    const reading = (label: string) => ({ topic: `/${label}`, label, text: 'read', tone: 'bad' }) as const;
    const facts = sessionFacts({ ...session, readings: [reading('Battery'), reading('Speed')] });
    expect(values(facts)).toMatchObject({ Battery: 'read', Speed: '0.50 m/s  -0.25 rad/s' });
    expect(values(facts)['Speed (/Speed)']).toBe('read');
  });
});

test('on the wrist: how to release while the stop is on, otherwise how to drive and to stop, whatever is read', () => {
  const words = { text: 'Live', tone: 'good' } as const;
  const facts = {
    heard: true,
    ...{ link: words, driving: words, telemetry, estopLatched: false, figures, estopAtRobot: false },
    ...{ stop: null, afterGap: 'let-go' as const, driveHand: 'right' as const, view: null },
    ...{ speed: null, near: null, hazards: null, readings: true },
  };
  const lines = wristLines({ ...facts, alarm: null, nextRobot: { id: 'b', name: 'B' } });
  expect(lines.map(({ text }) => text)).toEqual([
    'Live',
    'Stationary',
    'Live',
    'Battery 20 %  12.3k points  10/s  3.2 Mbit/s',
    'rtt 42 ms  frame –  loss 0.0 %',
    'Squeeze right: drive  B: stop  press right stick: B',
  ]);
  const unheard = wristLines({ ...facts, heard: false, alarm: null, nextRobot: null });
  expect(unheard.map(({ text }) => text)).toEqual([
    'Live',
    'Live',
    'points –',
    'rtt –  frame –  loss –',
    'Squeeze right: drive  B: stop',
  ]);
  const few = wristLines({ ...facts, readings: false, alarm: null, nextRobot: null });
  expect(few.map(({ text }) => text)).toEqual([
    'Live',
    'Stationary',
    'Live',
    'Squeeze right: drive  B: stop',
  ]);
  const speed = { text: '0.50 m/s, at most 1.00', tone: 'neutral' } as const;
  const near = { text: '0.3 m ahead left', tone: 'bad' } as const;
  const aware = wristLines({ ...facts, speed, near, alarm: null, nextRobot: null });
  expect(aware.slice(1, 4).map(({ text }) => text)).toEqual(['Stationary', speed.text, near.text]);
  expect(aware).toHaveLength(8);
  const tinted = wristLines({ ...facts, hazards: 'Red: would hit', alarm: null, nextRobot: null });
  expect(tinted.at(-1)?.text).toBe('Red: would hit  Squeeze right: drive  B: stop');
  const atRobot = wristLines({
    ...facts,
    alarm: null,
    nextRobot: null,
    estopLatched: true,
    estopAtRobot: true,
  });
  expect(atRobot.at(-1)).toEqual({ text: 'Released at the robot only', tone: 'bad' });
  const stopped = wristLines({ ...facts, alarm: null, nextRobot: null, estopLatched: true });
  expect(stopped.at(-1)?.tone).toBe('bad');
  const alarm = { text: 'The battery is low', tone: 'bad' } as const;
  const quiet = { ...facts, readings: false, nextRobot: null };
  expect(wristLines({ ...quiet, alarm })).toContainEqual(alarm);
  const alarmed = wristLines({ ...facts, alarm, nextRobot: null, estopLatched: true });
  expect(alarmed).toHaveLength(6);
  expect(alarmed).toContainEqual(alarm);
  expect(alarmed.at(-1)).toEqual(stopped.at(-1));
  // That STOP has not arrived matters more than any alarm.
  const stop = { text: 'STOP not yet confirmed', tone: 'warning' } as const;
  const unconfirmed = wristLines({ ...facts, alarm, stop, nextRobot: null });
  expect(unconfirmed).toHaveLength(6);
  expect(unconfirmed).toContainEqual(stop);
  const confirmed = { text: 'STOP confirmed', tone: 'good' } as const;
  expect(wristLines({ ...facts, alarm, stop: confirmed, nextRobot: null })).toContainEqual(alarm);
  expect(wristLines({ ...facts, alarm: null, stop: confirmed, nextRobot: null })).toContainEqual(confirmed);
});
