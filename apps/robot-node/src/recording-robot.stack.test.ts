/** The robot program recording: processes, signaling, WebRTC. How it plays: played-recording.stack.test.ts. */
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import { ALARM_TYPES, openRecording, SAMPLE_TYPES } from '@farpoint/recording';
import { DIAGNOSTIC_TYPES, foxgloveCompressedImageSchema } from '@farpoint/ros';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import * as z from 'zod';
import { metricOf } from './testing/metric-of.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const RECORDED = 'recorded-1';
const folder = useFolder();
const path = join(folder, 'drive.mcap');

const PICTURES = '/farpoint/pictures/Camera';
const cloudSchema = z.object({
  header: z.object({ stamp: z.object({ sec: z.number(), nanosec: z.number() }) }),
  ...{ width: z.int(), height: z.int(), point_step: z.literal(16) },
});
const latencySchema = z.object({ points: z.int(), capturedAtMs: z.number() });

interface SentFrame {
  points: number;
  /** When it was captured, on a clock that may begin anywhere, ms. */
  ms: number;
}

/** Frames that are among both, by their times: where a machine stalls, the recorder drops some of either. */
function ofBoth(clouds: readonly SentFrame[], told: readonly SentFrame[]): [SentFrame, SentFrame][] {
  const pairsAt = (offsetMs: number) =>
    clouds.flatMap((cloud): [SentFrame, SentFrame][] => {
      const same = told.find(({ ms }) => Math.abs(cloud.ms - offsetMs - ms) < 0.05);
      return same === undefined ? [] : [[cloud, same]];
    });
  const [first] = clouds;
  if (first === undefined) return [];
  // The right beginning is that at which most agree.
  return told
    .slice(0, 20)
    .map(({ ms }) => pairsAt(first.ms - ms))
    .reduce((best, pairs) => (pairs.length > best.length ? pairs : best), []);
}

async function withRobot(
  id: string,
  options: string[],
  use: (operator: SignaledOperator, metric: (name: string) => Promise<number>) => Promise<void>,
) {
  // This test does not check how much a busy computer lets through.
  const args = [...options, '--rate-control', 'fixed'];
  const stack = await LocalStack.start({ robots: [{ id, name: 'Robot', args }] });
  try {
    const operator = await SignaledOperator.connect(stack.signalingUrl, id);
    await use(operator, (name) => metricOf(stack.robotAdminUrl(id), `farpoint_robot_${name}`));
    await operator.close();
  } finally {
    await stack.stop();
  }
}

describe('robot process that records', { timeout: 60_000 }, () => {
  it('records clouds as captured and as sent, pictures, commands, telemetry, estimates and latencies', async () => {
    const args = ['--sim-size', '64', '--max-points', '600', '--record', path, '--record-fps', '120'];
    args.push('--record-clouds', 'both', '--pictures-of-cloud');
    args.push('--sim-charge', '15', '--sim-origin', '48.1374,11.5755');
    const seen: Uint8Array[] = [];
    const commands = { accepted: 0, dropped: 0 };
    await withRobot(RECORDED, args, async ({ client }, metric) => {
      expect(await client.message('cameras')).toMatchObject({ cameras: [{ name: 'Camera' }] });
      client.sendSession({ type: 'pictures', cameras: [0] });
      await client.until(() => {
        const { bytes } = client.pictures.get(0) ?? {};
        if (bytes !== undefined && bytes !== seen.at(-1)) seen.push(bytes);
        return seen.length >= 3;
      });
      await client.until(() => client.newest.diagnostics !== undefined && client.samples.length >= 10);
      const lease = await client.takeLease();
      await client.until(() => client.telemetry !== null);
      const start = client.telemetry?.pose.position.x ?? 0;
      const timer = setInterval(() => client.drive(lease, 0.3), 20);
      await client.until(() => (client.telemetry?.pose.position.x ?? 0) > start + 0.1);
      clearInterval(timer);
      client.sendSession({ type: 'latencyMeasured', id: 1, frameNumber: 7, mtpMs: 98.5, firstMs: 91 });
      // A command without a lease is refused.
      client.drive('0'.repeat(32), 0.3);
      await client.until(() => client.telemetry?.drive === 'watchdog');
      commands.accepted = await metric('commands_accepted_total');
      commands.dropped = await metric('recording_dropped_total{kind="events"}');
    });
    const recording = await openRecording(path);
    expect(recording.warning).toBeNull();
    const topics = new Map(recording.topics.map((topic) => [topic.name, topic]));
    const messagesOf = (name: string) => topics.get(name)?.messages ?? 0;
    const [captured, sent] = [messagesOf('/farpoint/captured'), messagesOf('/farpoint/sent')];
    expect(captured).toBeGreaterThan(5);
    expect(sent).toBeGreaterThan(5);
    for (const name of ['/farpoint/telemetry', '/farpoint/estimates', '/farpoint/cmd_vel', '/odom', '/tf'])
      expect(messagesOf(name), name).toBeGreaterThan(5);

    // What the robot tells about itself.
    const of = (types: readonly string[]) =>
      recording.topics.filter(({ type, messages }) => types.includes(type) && (messages ?? 0) > 0);
    expect(of(SAMPLE_TYPES).map(({ name }) => name)).toEqual([
      ...['/farpoint/quantities/motors_left', '/farpoint/quantities/motors_right'],
      ...['latitude', 'longitude', 'altitude'].map((field) => `/farpoint/quantities/fix_${field}`),
    ]);
    expect(of(ALARM_TYPES).map(({ name }) => name)).toEqual(['/farpoint/alarms/charge']);
    expect(of(DIAGNOSTIC_TYPES).map(({ name }) => name)).toEqual(['/diagnostics']);

    // Every point that was sent is in the recording.
    const clouds: SentFrame[] = [];
    const told: SentFrame[] = [];
    const verdicts = { accepted: 0, refused: 0 };
    const measured: unknown[] = [];
    const pictures: Buffer[] = [];
    const audited: unknown[] = [];
    for await (const { topic, data } of recording.messages([...topics.keys()], recording.startNs)) {
      const message = topic.decode(data);
      if (topic.name === '/farpoint/captured') {
        expect(cloudSchema.parse(message)).toMatchObject({ width: 64, height: 64 });
      } else if (topic.name === '/farpoint/sent') {
        const { width, header } = cloudSchema.parse(message);
        clouds.push({ points: width, ms: header.stamp.sec * 1000 + header.stamp.nanosec / 1e6 });
      } else if (topic.name === PICTURES) {
        const { data: file, format, frame_id } = foxgloveCompressedImageSchema.parse(message);
        expect([format, frame_id]).toEqual(['jpeg', 'camera_optical_frame']);
        pictures.push(Buffer.from(file));
      } else if (topic.name === '/farpoint/latencies') {
        const { points, capturedAtMs } = latencySchema.parse(message);
        told.push({ points, ms: capturedAtMs });
      } else if (topic.name === '/farpoint/audit') {
        audited.push(message);
      } else if (topic.name === '/farpoint/motion_to_photon') {
        measured.push(message);
      } else if (topic.name === '/farpoint/commands') {
        const { accepted } = z.object({ accepted: z.boolean() }).parse(message);
        verdicts[accepted ? 'accepted' : 'refused']++;
      }
    }
    // Byte for byte what the operator got.
    for (const bytes of seen) expect(pictures.some((file) => file.equals(bytes))).toBe(true);
    const both = ofBoth(clouds, told);
    expect(both.length).toBeGreaterThan(5);
    for (const [cloud, frame] of both) expect(cloud.points).toBe(frame.points);
    expect(clouds.map(({ points }) => points)).toContain(600);
    // How many come depends on the machine; each is in the recording, unless the recorder says that it dropped it.
    expect(verdicts.accepted).toBeGreaterThan(0);
    expect(verdicts.accepted).toBeLessThanOrEqual(commands.accepted);
    expect(verdicts.accepted).toBeGreaterThanOrEqual(commands.accepted - commands.dropped);
    expect(verdicts.refused).toBeGreaterThan(0);
    const subject = { name: 'test operator', proven: false };
    expect(audited.slice(0, 2)).toMatchObject([
      { kind: 'session-began', subject },
      { kind: 'lease-given', subject },
    ]);
    expect(measured).toMatchObject([{ id: 1, frameNumber: 7, mtpMs: 98.5, firstMs: 91 }]);
    await recording.close();
  });
});
