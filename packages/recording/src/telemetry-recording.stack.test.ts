/** Quantities, alarms and reports of components: written by the recorder, read by this project and by others. */
import { join } from 'node:path';
import type { Alarm, DiagnosticReport } from '@farpoint/protocol';
import { DiagnosticBoard, stampNs } from '@farpoint/ros';
import { useFolder } from '@farpoint/service/testing/folder';
import { beforeAll, describe, expect, it } from 'vitest';
import { openRecording } from './open-recording.ts';
import { alarmRecordSchema, quantityOf, sampleRecordSchema, sincesOf } from './recorded-telemetry.ts';
import type { RecordedTopic } from './recording.ts';
import { SessionRecorder } from './session-recorder.ts';
import { Peers } from './testing/peers.ts';

const EPOCH_MS = 1_700_000_000_000;
const folder = useFolder();
const path = join(folder, 'drive.mcap');

const QUANTITIES = [
  { topic: '/motors', field: 'left', label: 'Left motor', unit: '°C' },
  { topic: '/gripper', field: 'data', label: 'Gripper', unit: '' },
];
const LEFT = '/farpoint/quantities/motors_left';
const GRIPPER = '/farpoint/quantities/gripper';
const CHARGE = '/farpoint/alarms/charge';
const SPEED = '/farpoint/alarms/speed';
const raised: Omit<Alarm, 'type' | 'number'> = {
  ...{ level: 'warn', text: 'The battery is low – drive home', value: 19.5, limit: 20, unit: '%' },
  sinceMs: 1500,
};
const REPORTS: DiagnosticReport[] = [
  { name: 'lidar', level: 'error', message: 'no data', sinceMs: 250 },
  { name: 'imu', level: 'ok', message: '', sinceMs: 0 },
  { name: 'gripper', level: 'stale', message: 'gone', sinceMs: 100.5 },
  { name: 'fan', level: 'warn', message: 'slow', sinceMs: 3 },
];

/** Messages of a topic, with the time at which they were recorded, ms of the robot's clock. */
async function read(name: string): Promise<{ topic: RecordedTopic; ms: number; message: unknown }[]> {
  const recording = await openRecording(path);
  const messages = [];
  for await (const { topic, logNs, data } of recording.messages([name], 0n))
    messages.push({ topic, ms: Number(logNs / 1000n) / 1000 - EPOCH_MS, message: topic.decode(data) });
  await recording.close();
  return messages;
}
const msOf = (stamp: { sec: number; nanosec: number }) => Number(stampNs(stamp) / 1000n) / 1000 - EPOCH_MS;

beforeAll(async () => {
  const recorder = await SessionRecorder.open({
    ...{ path, compression: 'none', robotId: 'test', epochNs: BigInt(EPOCH_MS) * 1_000_000n },
  });
  const alarms = ['charge', 'speed'].map((watches) => ({ watches, label: watches }));
  recorder.telemetry(QUANTITIES, alarms);
  for (let k = 0; k < 50; k++) recorder.sample(0, 1000 + k * 20.25, 20 + k / 8);
  recorder.sample(1, 1010, -1e-300);
  recorder.alarm(0, 1500, raised);
  recorder.alarm(0, 6500, raised);
  recorder.alarm(0, 7000, { ...raised, level: 'ok', value: 22.5, sinceMs: 7000 });
  for (const timeMs of [1000, 2000]) recorder.diagnostics('/diagnostics', timeMs, REPORTS);
  // What was not announced is counted, and disturbs nothing.
  recorder.sample(2, 3000, 1);
  recorder.alarm(2, 3000, raised);
  recorder.clouds.close();
  await recorder.close();
  expect(recorder.faults).toBe(2);
  expect(recorder.dropped.events).toBe(0);
});

describe('a recording', () => {
  it('has each quantity’s samples at the times at which they were measured', async () => {
    const samples = await read(LEFT);
    expect(quantityOf(samples[0]!.topic)).toEqual(QUANTITIES[0]);
    expect(samples).toHaveLength(50);
    samples.forEach(({ ms, message }, k) => {
      const { header, value } = sampleRecordSchema.parse(message);
      expect(value).toBe(20 + k / 8);
      expect(ms).toBeCloseTo(1000 + k * 20.25, 2);
      expect(msOf(header.stamp)).toBeCloseTo(ms, 2);
    });
    const [gripper] = await read(GRIPPER);
    expect(sampleRecordSchema.parse(gripper?.message).value).toBe(-1e-300);
    expect(quantityOf(gripper!.topic)).toEqual(QUANTITIES[1]);
  });

  it('has each change of an alarm when it was judged; a repeated one says since when', async () => {
    const changes = await read(CHARGE);
    expect(changes.map(({ ms }) => ms)).toEqual([1500, 6500, 7000]);
    const parsed = changes.map(({ message }) => alarmRecordSchema.parse(message));
    expect(parsed.map(({ level }) => level)).toEqual(['warn', 'warn', 'ok']);
    expect(parsed.map(({ header }) => msOf(header.stamp))).toEqual([1500, 1500, 7000]);
    const { sinceMs: _, ...told } = raised;
    expect(parsed[0]).toMatchObject(told);
    expect(await read(SPEED)).toEqual([]);
  });

  it('has the reports of all components, as ROS 2’s diagnostics', async () => {
    const [first] = await read('/diagnostics');
    expect(first?.topic.type).toBe('diagnostic_msgs/msg/DiagnosticArray');
    const board = new DiagnosticBoard();
    board.take(first?.message, 0);
    const known = ({ name, level, message }: DiagnosticReport) => ({ name, level, message });
    expect(board.components.map(known)).toEqual(REPORTS.map(known));
    expect(sincesOf(first?.message).get('lidar')).toBe(EPOCH_MS + 250);
  });
});

const peers = Peers.install();
describe.skipIf(typeof peers === 'string')(
  `read by PyPI’s mcap and rosbags ${typeof peers === 'string' ? `(${peers})` : ''}`,
  { timeout: 60_000 },
  () => {
    it('every message, by the schemas in the file', () => {
      const { topics } = (peers as Peers).read(path);
      expect(topics[LEFT]).toMatchObject({
        ...{ type: 'farpoint_msgs/msg/Sample', count: 50, sequence: 49, metadata: QUANTITIES[0] },
      });
      expect(topics[CHARGE]).toMatchObject({ type: 'farpoint_msgs/msg/Alarm', count: 3 });
      expect(topics['/diagnostics']).toMatchObject({ count: 2 });
      const counted = (peers as Peers).count(path);
      expect(counted).toMatchObject({ [LEFT]: 50, [GRIPPER]: 1, [CHARGE]: 3, '/diagnostics': 2 });
    });
  },
);
