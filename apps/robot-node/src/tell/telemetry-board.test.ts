import type { Alarm, DiagnosticReport } from '@farpoint/protocol';
import { beforeEach, describe, expect, it } from 'vitest';
import { TelemetryBoard } from './telemetry-board.ts';

const own = {
  type: 'quantity',
  number: 0,
  topic: '/motors',
  field: 'left',
  label: 'Left',
  unit: '°C',
} as const;
const rule = { watches: '/motors left', label: 'Left', unit: '°C', high: { warn: 80 }, hysteresis: 0 };
const played = {
  quantities: [{ topic: '/arm', field: 'data', label: 'Arm', unit: 'A' }],
  alarms: [{ watches: 'charge', label: 'Battery' }],
};
const low = {
  level: 'warn',
  text: 'The battery is low',
  value: 19,
  limit: 20,
  unit: '%',
  sinceMs: 90,
} as const;

describe('TelemetryBoard', () => {
  let recorded: [what: string, of: number | string, timeMs: number, value: unknown][];
  let board: TelemetryBoard;

  beforeEach(() => {
    recorded = [];
    board = new TelemetryBoard([own], [rule], played);
    board.taker = {
      sample: (quantity, timeMs, value) => recorded.push(['sample', quantity, timeMs, value]),
      alarm: (number, timeMs, { level }: Alarm) => recorded.push(['alarm', number, timeMs, level]),
      diagnostics: (topic, timeMs, reports: readonly DiagnosticReport[]) =>
        recorded.push(['diagnostics', topic, timeMs, reports.length]),
    };
  });

  it('gives a recording every sample, every report, and alarms when they were judged', () => {
    board.sample('/motors', [75], 100);
    board.sample('/motors', [85], 120);
    const components: DiagnosticReport[] = [{ name: 'imu', level: 'ok', message: '', sinceMs: 0 }];
    board.take({ topic: '/diagnostics', label: 'D', level: 'ok', values: [], components }, 130);
    expect(board.alarmChanges(150)).toMatchObject([{ number: 0, level: 'warn', sinceMs: 120 }]);
    board.sample('/motors', [70], 160);
    board.alarmChanges(200);
    expect(recorded).toEqual([
      ['sample', 0, 100, 75],
      ['sample', 0, 120, 85],
      ['diagnostics', '/diagnostics', 130, 1],
      ['alarm', 0, 120, 'warn'],
      ['sample', 0, 160, 70],
      ['alarm', 0, 160, 'ok'],
    ]);
  });

  it('judges what is known of the battery, and nothing else', () => {
    const rules = ['charge', 'voltage'].map((watches) => ({
      ...{ watches, label: watches, unit: '', low: { warn: 20 }, hysteresis: 0 },
    }));
    const judge = new TelemetryBoard([], rules, { quantities: [], alarms: [] });
    const zero = { x: 0, y: 0, z: 0 };
    const state = (battery: object | null, timeMs: number) =>
      judge.state({ timeMs, twist: { linear: zero, angular: zero }, battery } as never);
    state(null, 100);
    state({ voltage: 19 }, 110);
    expect(judge.alarmChanges(150)).toMatchObject([{ number: 1, level: 'warn', value: 19 }]);
    state({ percentage: 0.1 }, 160);
    expect(judge.alarmChanges(200)).toMatchObject([{ number: 0, level: 'warn', value: 10 }]);
  });

  it('passes on what navigators say, and tells it to people', () => {
    const navigation = {
      kind: 'path' as const,
      points: [
        [0, 0],
        [1, 0],
      ] as [number, number][],
    };
    board.take({ topic: '/plan', label: 'Path', level: 'ok', values: [['', '1.0 m']], navigation }, 130);
    expect(board.navigation.next({}, 'wide', 150)).toMatchObject([
      { type: 'path', topic: '/plan', ageMs: 20 },
    ]);
    const reading = board.readings.next(150);
    expect(reading).toMatchObject({ topic: '/plan', values: [['', '1.0 m']] });
    expect(reading).not.toHaveProperty('navigation');
  });

  it('records raised alarms again every five seconds, so that a player can begin anywhere', () => {
    board.sample('/motors', [85], 100);
    for (let nowMs = 150; nowMs <= 12_000; nowMs += 50) board.alarmChanges(nowMs);
    const alarms = recorded.filter(([what]) => what === 'alarm');
    expect(alarms.map(([, , timeMs]) => timeMs)).toEqual([100, 5000, 10_000]);
  });

  it('shows what a recording tells, marked, beside its own, and does not judge it again', () => {
    expect(board.quantities).toEqual([
      own,
      { type: 'quantity', number: 1, ...played.quantities[0], recorded: true },
    ]);
    board.play({ kind: 'sample', quantity: 0, value: 5, timeMs: 100 });
    board.play({ kind: 'sample', quantity: 1, value: 5, timeMs: 100 });
    expect(board.samples.all()?.samples).toEqual([[1, 0, 5]]);
    board.play({ kind: 'alarm', alarm: 0, state: low });
    board.play({ kind: 'alarm', alarm: 1, state: low });
    const alarm = { type: 'alarm', number: 1, ...low, recorded: true };
    expect(board.alarmChanges(100)).toEqual([alarm]);
    // The recorder repeats it.
    board.play({ kind: 'alarm', alarm: 0, state: { ...low, sinceMs: 90.2 } });
    expect(board.alarmChanges(150)).toEqual([]);
    expect(board.alarms.raised).toEqual([alarm]);
    const reports: DiagnosticReport[] = [{ name: 'imu', level: 'ok', message: '', sinceMs: 0 }];
    board.play({ kind: 'diagnostics', topic: '/diagnostics', reports, timeMs: 100 });
    expect(board.components.next(100)).toMatchObject({ topic: '/diagnostics', recorded: true, reports });
  });

  it('clears recorded alarms when playing begins anew, and no other', () => {
    board.sample('/motors', [85], 100);
    board.play({ kind: 'alarm', alarm: 0, state: low });
    board.alarmChanges(100);
    board.play({ kind: 'restart', timeMs: 200 });
    expect(board.alarmChanges(200)).toMatchObject([{ number: 1, level: 'ok', sinceMs: 200, recorded: true }]);
    expect(board.alarms.raised.map(({ number }) => number)).toEqual([0]);
  });
});
