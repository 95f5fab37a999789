import type { PlayedMessage } from '@farpoint/cloud-source';
import { type RecordedMessage, type RecordedTopic, RecordingError } from '@farpoint/recording';
import fc from 'fast-check';
import { beforeEach, describe, expect, it } from 'vitest';
import { RecordedTelemetry } from './recorded-telemetry.ts';

const topicOf = (name: string, type: string, metadata: Record<string, string> = {}): RecordedTopic => ({
  ...{ name, type, messages: 10, metadata: new Map(Object.entries(metadata)) },
  decode: (data) => JSON.parse(new TextDecoder().decode(data)) as unknown,
});
const LEFT = topicOf('/farpoint/quantities/motors_left', 'farpoint_msgs/msg/Sample', {
  ...{ topic: '/motors', field: 'left', label: 'Left motor', unit: '°C' },
});
const FOREIGN = topicOf('/bench/force', 'farpoint_msgs/msg/Sample', { unit: 'a unit that is far too long' });
const CHARGE = topicOf('/farpoint/alarms/charge', 'farpoint_msgs/msg/Alarm', {
  ...{ watches: 'charge', label: 'Battery' },
});
const DIAGNOSTICS = topicOf('/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray');
const NAMED = topicOf('/named', 'diagnostic_msgs/msg/DiagnosticArray');
const EMPTY = { ...topicOf('/empty', 'farpoint_msgs/msg/Sample'), messages: 0 };
const CLOUDS = topicOf('/points', 'sensor_msgs/msg/PointCloud2');

const stampOf = (ms: number) => ({ sec: Math.floor(ms / 1000), nanosec: Math.round((ms % 1000) * 1e6) });
/** A message that was recorded at 100 s. */
const message = (topic: RecordedTopic, value: unknown): RecordedMessage => ({
  ...{ topic, logNs: 100_000_000_000n, offset: 0 },
  data: new TextEncoder().encode(JSON.stringify(value)),
});
const alarm = (level: string, more: object = {}) => ({
  header: { stamp: stampOf(97_500) },
  ...{ level, text: 'The battery is low', value: 19, limit: 20, unit: '%', ...more },
});
const status = (name: string, level: number, since?: string) => ({
  ...{ level, name, message: 'm', hardware_id: '' },
  values: since === undefined ? [] : [{ key: 'since', value: since }],
});
const reports = (...all: object[]) => ({ header: { stamp: stampOf(0), frame_id: '' }, status: all });

describe('RecordedTelemetry', () => {
  let telemetry: RecordedTelemetry;
  let told: PlayedMessage[];

  beforeEach(() => {
    told = [];
    telemetry = new RecordedTelemetry([CLOUDS, LEFT, FOREIGN, CHARGE, DIAGNOSTICS, NAMED, EMPTY], ['/named']);
    telemetry.onMessage = (each) => told.push(each);
  });

  it('finds quantities, alarms and diagnostics by their types', () => {
    expect(telemetry.topics).toEqual([LEFT.name, FOREIGN.name, CHARGE.name, '/diagnostics']);
    expect(telemetry.description).toEqual({
      quantities: [
        { topic: '/motors', field: 'left', label: 'Left motor', unit: '°C' },
        // Its recorder noted nothing that can be used.
        { topic: '/bench/force', field: 'value', label: '/bench/force', unit: '' },
      ],
      alarms: [{ watches: 'charge', label: 'Battery' }],
    });
  });

  it('tells samples at the time at which they are due', () => {
    expect(telemetry.take(message(LEFT, { header: { stamp: stampOf(100_000) }, value: 25 }), 5000)).toBe(
      true,
    );
    expect(told).toEqual([{ kind: 'sample', quantity: 0, value: 25, timeMs: 5000 }]);
    expect(telemetry.take(message(CLOUDS, {}), 5000)).toBe(false);
    expect(telemetry.take(message(NAMED, reports()), 5000)).toBe(false);
  });

  it('tells since when an alarm had its level, never from before the robot’s clock began', () => {
    telemetry.take(message(CHARGE, alarm('warn')), 5000);
    telemetry.take(message(CHARGE, alarm('error')), 1000);
    telemetry.take(message(CHARGE, alarm('ok', { header: { stamp: stampOf(100_250) } })), 6000);
    const states = told.map((each) => (each.kind === 'alarm' ? [each.state.level, each.state.sinceMs] : []));
    expect(states).toEqual([
      ['warn', 2500],
      ['error', 0],
      ['ok', 6000],
    ]);
  });

  it('merges partial diagnostics, and forgets them when playing begins anew', () => {
    telemetry.take(message(DIAGNOSTICS, reports(status('lidar', 2, new Date(96_000).toISOString()))), 5000);
    telemetry.take(message(DIAGNOSTICS, reports(status('imu', 1, 'yesterday'))), 6000);
    expect(told[1]).toEqual({
      ...{ kind: 'diagnostics', topic: '/diagnostics', timeMs: 6000 },
      reports: [
        { name: 'lidar', level: 'error', message: 'm', sinceMs: 5000 },
        { name: 'imu', level: 'warn', message: 'm', sinceMs: 6000 },
      ],
    });
    expect(told[0]).toMatchObject({ reports: [{ name: 'lidar', sinceMs: 1000 }] });
    telemetry.restart(7000);
    telemetry.take(message(DIAGNOSTICS, reports(status('imu', 0))), 7000);
    expect(told.slice(2)).toEqual([
      { kind: 'restart', timeMs: 7000 },
      expect.objectContaining({ reports: [expect.objectContaining({ name: 'imu', level: 'ok' })] }),
    ]);
  });

  it.each([
    [LEFT, { header: { stamp: stampOf(0) }, value: null }, 'value'],
    [LEFT, { value: 1 }, 'header'],
    [CHARGE, alarm('fatal'), 'level'],
    [CHARGE, alarm('warn', { text: '' }), 'text'],
    [CHARGE, alarm('warn', { unit: 'thirteen bytes' }), 'unit'],
    [DIAGNOSTICS, { header: {}, status: 'all is well' }, 'status'],
  ])('refuses what does not match its type: %o %o', (topic, value, what) => {
    const take = () => telemetry.take(message(topic, value), 5000);
    expect(take).toThrow(RecordingError);
    expect(take).toThrow(
      expect.objectContaining({ code: 'bad-message', detail: expect.stringContaining(what) }),
    );
    expect(told).toEqual([]);
  });

  it('whatever a message says, it is told or refused by name', () => {
    const topics = fc.constantFrom(LEFT, CHARGE, DIAGNOSTICS);
    const likely = fc.oneof(
      fc.jsonValue(),
      fc.record({ header: fc.constant({ stamp: stampOf(5), frame_id: '' }), value: fc.jsonValue() }),
      fc.record({
        header: fc.constant({ stamp: stampOf(5), frame_id: '' }),
        status: fc.array(fc.jsonValue()),
      }),
    );
    fc.assert(
      fc.property(topics, likely, (topic, value) => {
        const before = told.length;
        try {
          telemetry.take(message(topic, value), 5000);
          expect(told.length).toBe(before + 1);
        } catch (error) {
          expect(error).toMatchObject({ name: 'RecordingError', code: 'bad-message' });
          expect(told.length).toBe(before);
        }
      }),
    );
  });
});
