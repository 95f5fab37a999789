import type { Telemetry, Welcome } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { RobotVoice } from '../../testing/robot-voice.ts';
import { OWN, TelemetryRecorder } from './recorder.ts';

class Bench extends RobotVoice {
  readonly recorder = new TelemetryRecorder(this, () => 7);

  begin(robotId: string): void {
    this.say('session', 1);
    this.say('welcome', { robotId } as Welcome);
  }

  state(timeMs: number, more: Partial<Telemetry> = {}): void {
    const zero = { x: 0, y: 0, z: 0 };
    this.say('telemetry', {
      ...{ timeMs, battery: { voltage: 24, percentage: 0.5 } },
      pose: {
        position: { ...zero, x: timeMs / 1000 },
        orientation: { ...zero, z: Math.SQRT1_2, w: Math.SQRT1_2 },
      },
      twist: { linear: { ...zero, x: -0.5 }, angular: zero },
      ...more,
    } as Telemetry);
  }

  describe(number: number, field: string, unit: string): void {
    this.say('quantity', { type: 'quantity', number, topic: '/t', field, label: field, unit });
  }

  newest(key: string): number | undefined {
    return this.recorder.series.get(key)?.series.at(1e12)?.value;
  }
}

test('records the robot’s state in units for people, with the time at which it was measured', () => {
  const bench = new Bench();
  bench.begin('a');
  bench.state(1000, { ageMs: 200 });
  expect(bench.newest(OWN.speed.key)).toBe(-0.5);
  expect(bench.newest(OWN.heading.key)).toBeCloseTo(90);
  expect(bench.newest(OWN.charge.key)).toBe(50);
  expect(bench.recorder.series.get(OWN.speed.key)?.series.newestMs).toBe(800);
  // The odometry has stopped: the same measurement, older.
  bench.state(1100, { ageMs: 300 });
  expect(bench.recorder.series.get(OWN.speed.key)?.series.length).toBe(1);
});

test('records the quantities of topics, and the position on the earth', () => {
  const bench = new Bench();
  bench.begin('a');
  bench.describe(0, 'percentage', '%');
  bench.describe(1, 'latitude', '°');
  bench.describe(2, 'longitude', '°');
  bench.state(1000);
  // The battery has a topic of its own.
  expect(bench.newest(OWN.charge.key)).toBeUndefined();
  const sample = (timeMs: number) => ({
    ...{ type: 'samples' as const, timeMs },
    samples: [
      [0, -5, 40],
      [1, 0, 48 + timeMs / 1e6],
      [2, 0, 11],
      [9, 0, 1],
    ] as [number, number, number][],
  });
  bench.say('samples', sample(1000));
  bench.say('samples', sample(2000));
  expect(bench.newest('/t percentage')).toBe(40);
  expect(bench.recorder.charge?.series.newestMs).toBe(1995);
  expect(bench.recorder.fixTrack.length).toBe(2);
  expect(bench.recorder.fixTrack.yAt(1)).toBeCloseTo(48.002);
});

test('marks the quantities of a recording, and keeps them apart from the robot’s own', () => {
  const bench = new Bench();
  bench.begin('a');
  bench.describe(0, 'left', '°C');
  const recorded = {
    number: 1,
    topic: '/t',
    field: 'left',
    label: 'left',
    unit: '°C',
    recorded: true,
  } as const;
  bench.say('quantity', { type: 'quantity', ...recorded });
  const samples: [number, number, number][] = [
    [0, 0, 20],
    [1, 0, 70],
  ];
  bench.say('samples', { type: 'samples', timeMs: 1000, samples });
  const shown = [...bench.recorder.series.values()].map(({ label, recorded, series }) => [
    label,
    recorded,
    series.at(1e12)?.value,
  ]);
  expect(shown).toEqual([
    ['left', undefined, 20],
    ['left', true, 70],
  ]);
});

test('keeps what it has over sessions with a robot, but not for another robot or another clock', () => {
  const bench = new Bench();
  bench.begin('a');
  for (let timeMs = 0; timeMs < 60_000; timeMs += 1000) bench.state(timeMs);
  bench.begin('a');
  bench.state(70_000);
  expect(bench.recorder.series.get(OWN.speed.key)?.series.length).toBe(61);
  expect(bench.recorder.track.length).toBe(61);
  bench.begin('a');
  bench.state(500);
  expect(bench.recorder.series.get(OWN.speed.key)?.series.length).toBe(1);
  bench.begin('b');
  expect(bench.recorder.series.size).toBe(0);
  expect(bench.recorder.track.length).toBe(0);
});

test('keeps a bounded number of series', () => {
  const bench = new Bench();
  for (let i = 0; i < 1000; i++) bench.describe(i % 64, `field ${i}`, '');
  expect(bench.recorder.series.size).toBe(128);
});

test('what the battery does not know is not recorded as 0', () => {
  const bench = new Bench();
  bench.state(1000, { battery: { voltage: 23 } });
  expect(bench.newest(OWN.charge.key)).toBeUndefined();
  expect(bench.newest(OWN.voltage.key)).toBe(23);
  bench.state(1050, { battery: { percentage: 0.4 } });
  expect(bench.newest(OWN.charge.key)).toBe(40);
});
