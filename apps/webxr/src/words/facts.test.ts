import type { Telemetry } from '@farpoint/protocol';
import { afterEach, describe, expect, test } from 'vitest';
import { sessionFacts } from './facts.ts';
import { speak } from './language.ts';
import type { PageStats } from './page-stats.ts';
import { wristLines } from './wrist-lines.ts';

afterEach(() => speak('en'));

const figures = {
  ...{ pointsPerFrame: 12_345.6, framesPerSecond: 10, bitsPerSecond: 3_210_000, lossRate: 0 },
  ...{ drawnOneOf: 1, remembered: null, minRttMs: 42, viewAgeMs: null, mtpMs: null },
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
  pointsHeard: true,
  drives: true,
  name: 'Rover',
  telemetry,
  estop: open,
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
    expect(values(sessionFacts({ ...session, figures: seen, drives: false })).View).toBeUndefined();
  });

  test('without a word from the robot no figure of it is live; without points none of them', () => {
    const remembered = { points: 5, oldestS: 5 };
    const all = { ...session, figures: { ...figures, remembered } };
    const live = values(sessionFacts(all));
    const unheard = values(sessionFacts({ ...all, heard: false }));
    expect(Object.keys(unheard)).toEqual(Object.keys(live));
    const kept = Object.entries(unheard).filter(([, value]) => value !== '–');
    expect(kept).toEqual([
      ['Robot', 'Rover'],
      ['Remembered', 'up to 10 s old'],
    ]);
    expect(sessionFacts({ ...all, heard: false }).every(({ tone }) => tone === undefined)).toBe(true);
    const frozen = values(sessionFacts({ ...all, pointsHeard: false }));
    expect(frozen).toMatchObject({ Points: '–', Rate: '–', Loss: '–', 'View age': '–' });
    expect(frozen).toMatchObject({ State: 'Stationary', 'Round trip': '42 ms', Battery: '20 %  24.0 V' });
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

  test('a speed to the side is said where there is one, in both directions', async () => {
    const at = (y: number) => {
      const { telemetry } = session;
      const twist = { ...telemetry.twist, linear: { x: 0.5, y, z: 0 } };
      return values(sessionFacts({ ...session, telemetry: { ...telemetry, twist } }));
    };
    expect(at(0.2).Speed).toBe('0.50 m/s  0.20 m/s to the left  -0.25 rad/s');
    expect(at(-0.3).Speed).toBe('0.50 m/s  0.30 m/s to the right  -0.25 rad/s');
    expect(at(0.004).Speed).toBe('0.50 m/s  -0.25 rad/s');
    await speak('de');
    expect(at(0.2).Tempo).toBe('0,50 m/s  0,20 m/s nach links  -0,25 rad/s');
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
      'View age': '–',
    });
    const bare = sessionFacts({ ...session, name: null, telemetry: null });
    expect(bare.map(({ name }) => name)).toEqual(['Points', 'Rate', 'Loss', 'Round trip', 'View age']);
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
    expect(values(sessionFacts(stopped)).State).toBe('Stopped: no recent command');
    const motion = { factor: 1, reasons: [], mostLinear: 1, letGoFirst: true } as const;
    const state = (drive: string) =>
      values(sessionFacts({ ...session, telemetry: { ...telemetry, drive, motion } as Telemetry })).State;
    expect([state('watchdog'), state('idle')]).toEqual(
      Array.from({ length: 2 }, () => 'Stopped by a gap: let go, then drive'),
    );
    expect(state('driving')).toBe('Driving');
  });

  test('what the battery does not know is not 0', () => {
    const battery = (known: Telemetry['battery']) =>
      sessionFacts({ ...session, telemetry: { ...telemetry, battery: known } }).find(
        ({ name }) => name === 'Battery',
      );
    expect(battery({ voltage: 24.04 })).toMatchObject({ value: 'charge unknown  24.0 V', tone: 'neutral' });
    expect(battery({ percentage: 0.05 })).toMatchObject({ value: '5 %', tone: 'bad' });
    expect(battery(undefined)).toBeUndefined();
  });

  test('a reading replaces the battery row and no other', () => {
    const reading = (label: string) => ({ topic: `/${label}`, label, text: 'read', tone: 'bad' }) as const;
    const facts = sessionFacts({ ...session, readings: [reading('Battery'), reading('Speed')] });
    expect(values(facts)).toMatchObject({ Battery: 'read', Speed: '0.50 m/s  -0.25 rad/s' });
    expect(values(facts)['Speed (/Speed)']).toBe('read');
  });
});

test('on the wrist: how to release while the stop is on, otherwise the battery and the next robot', () => {
  const words = { text: 'Live', tone: 'good' } as const;
  const facts = {
    live: true,
    heard: true,
    pointsHeard: true,
    ...{ link: words, driving: words, telemetry, estopLatched: false, figures, estopAtRobot: false },
    ...{ stop: null, driveHand: 'right' as const, view: null },
    ...{ speed: null, near: null, hazards: null, alarm: null, nextRobot: null, noRobots: null },
  };
  const wrist = (more: Partial<Parameters<typeof wristLines>[0]> = {}) => wristLines({ ...facts, ...more });
  const lines = wrist({ nextRobot: { id: 'b', name: 'B' } });
  expect(lines.map(({ text }) => text)).toEqual([
    'Live',
    'Stationary',
    'Live',
    '12.3k points  10/s  3.2 Mbit/s',
    'rtt 42 ms  view – old  loss 0.0 %',
    'Battery 20 %  press right stick: B',
  ]);
  const speed = { text: '0.50 m/s, at most 1.00', tone: 'neutral' } as const;
  const near = { text: '0.3 m ahead left', tone: 'bad' } as const;
  const aware = wrist({ speed, near });
  expect(aware.slice(1, 4).map(({ text }) => text)).toEqual(['Stationary', speed.text, near.text]);
  expect(aware).toHaveLength(8);
  const tinted = wrist({ hazards: 'Red: would hit' });
  expect(tinted.at(-1)?.text).toBe('Red: would hit  Battery 20 %');
  // Nothing to drive: no hint of how.
  expect(wrist({ telemetry: null }).at(-1)?.text).toBe('');
  const without = wrist({ live: false, estopLatched: true, nextRobot: { id: 'b', name: 'B' } });
  expect(without.map(({ text }) => text)).toEqual(['Live', 'press right stick: B']);
  const noRobots = { text: 'No robots are online. They appear here.', tone: 'neutral' } as const;
  const alone = wrist({ live: false, noRobots }).map(({ text }) => text);
  expect(alone).toEqual(['Live', 'No robots are online.', '']);
  const unheard = wrist({ heard: false }).map(({ text }) => text);
  expect(unheard).toEqual(['Live', 'Live', 'points –', 'rtt –  view –  loss –', '']);
  const frozen = wrist({ pointsHeard: false }).map(({ text }) => text);
  expect(frozen).toContain('rtt 42 ms  view –  loss –');
  expect(frozen).toContain('Stationary');
  const atRobot = wrist({ estopLatched: true, estopAtRobot: true });
  expect(atRobot.at(-1)).toEqual({ text: 'Released at the robot only', tone: 'bad' });
  expect(wrist({ estopLatched: true, heard: false }).at(-1)?.text).toBe('STOP, as last heard');
  const stopped = wrist({ estopLatched: true });
  expect(stopped.at(-1)?.tone).toBe('bad');
  const alarm = { text: 'The battery is low', tone: 'bad' } as const;
  const alarmed = wrist({ alarm, estopLatched: true });
  expect(alarmed).toHaveLength(6);
  expect(alarmed).toContainEqual(alarm);
  expect(alarmed.at(-1)).toEqual(stopped.at(-1));
  // That STOP has not arrived matters more than any alarm.
  const stop = { text: 'STOP not yet confirmed', tone: 'warning' } as const;
  const unconfirmed = wrist({ alarm, stop });
  expect(unconfirmed).toHaveLength(6);
  expect(unconfirmed).toContainEqual(stop);
  const confirmed = { text: 'STOP confirmed', tone: 'good' } as const;
  expect(wrist({ alarm, stop: confirmed })).toContainEqual(alarm);
  expect(wrist({ stop: confirmed })).toContainEqual(confirmed);
});
