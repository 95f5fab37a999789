/** The robot program as a live source for Foxglove, with the official client. */
import { once } from 'node:events';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { freePorts } from '@farpoint/local-stack';
import { alarmRecordSchema, sampleRecordSchema } from '@farpoint/recording';
import {
  DiagnosticBoard,
  foxgloveCompressedVideoSchema,
  lazyDecoder,
  pointCloud2Schema,
  stampNs,
} from '@farpoint/ros';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { BUILD_REMEDY } from '@farpoint/video/build';
import { type Channel, FoxgloveClient } from '@foxglove/ws-protocol';
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { WebSocket } from 'ws';
import * as z from 'zod';
import { metricOf } from './testing/metric-of.ts';
import { useRobot } from './testing/use-robot.ts';
import { hasVideo } from './testing/watched-camera.ts';

const ROBOT = 'foxglove-1';
/** How a sequence parameter set begins. */
const SPS = Buffer.from([0, 0, 1, 0x67]);
const [port = 0] = await freePorts(1);
const folder = useFolder();
const config = join(folder, 'farpoint.yaml');
const front = { name: 'Front', source: { kind: 'test' }, encoder: 'x264enc', width: 320, height: 240 };
writeFileSync(config, JSON.stringify({ robot: { videos: hasVideo ? [front] : [] } }));

interface Received {
  ns: bigint;
  message: unknown;
}

/** A viewer: what it subscribed to, decoded by the advertised schemas. */
class Viewer {
  readonly received = new Map<string, Received[]>();
  readonly channels = new Map<string, Channel>();
  readonly errors: unknown[] = [];
  readonly #client: FoxgloveClient;
  readonly #ids = new Map<number, string>();

  private constructor() {
    const ws = new WebSocket(`ws://127.0.0.1:${port}`, ['foxglove.websocket.v1', 'foxglove.sdk.v1']);
    this.#client = new FoxgloveClient({ ws: ws as never });
    this.#client.on('error', (error) => this.errors.push(error));
    this.#client.on('advertise', (channels) => {
      for (const channel of channels) this.channels.set(channel.topic, channel);
    });
    this.#client.on('message', ({ subscriptionId, timestamp, data }) => {
      const topic = this.#ids.get(subscriptionId) ?? '';
      const { schemaName, encoding, schemaEncoding = '', schema } = this.channels.get(topic) as Channel;
      const decode = lazyDecoder({
        ...{ name: schemaName, messageEncoding: encoding, schemaEncoding },
        schema: new TextEncoder().encode(schema),
      });
      const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
      const all = this.received.get(topic) ?? [];
      this.received.set(topic, all);
      all.push({ ns: timestamp, message: decode(bytes) });
    });
  }

  static async connect(): Promise<Viewer> {
    const viewer = new Viewer();
    await vi.waitFor(() => expect(viewer.channels.size).toBeGreaterThan(5), { timeout: 20_000 });
    return viewer;
  }

  subscribe(topic: string): number {
    const id = this.#client.subscribe(this.channels.get(topic)?.id ?? 0);
    this.#ids.set(id, topic);
    return id;
  }

  unsubscribe(id: number): void {
    this.#client.unsubscribe(id);
  }

  async until(topic: string, count: number): Promise<Received[]> {
    const all = () => this.received.get(topic) ?? [];
    await vi.waitFor(() => expect(all().length, topic).toBeGreaterThanOrEqual(count), { timeout: 20_000 });
    return all();
  }

  close(): void {
    this.#client.close();
  }
}

describe('a robot in Foxglove', { timeout: 60_000 }, () => {
  const robot = useRobot(ROBOT, [
    ...['--config', config, '--sim-size', '256', '--max-points', '600', '--sim-charge', '15'],
    ...['--foxglove-port', String(port), '--foxglove-fps', '60'],
  ]);
  const metric = (name: string) => metricOf(robot.stack.robotAdminUrl(ROBOT), `farpoint_robot_${name}`);
  const connect = async () => {
    const viewer = await Viewer.connect();
    onTestFinished(() => viewer.close());
    return viewer;
  };

  it('shows clouds, poses and telemetry although no operator watches', async () => {
    const viewer = await connect();
    expect([...viewer.channels.keys()]).toEqual(
      expect.arrayContaining([
        ...['/farpoint/captured', '/farpoint/sent', '/tf', '/odom', '/farpoint/cmd_vel'],
        ...['/farpoint/commands', '/farpoint/telemetry', '/farpoint/estimates'],
      ]),
    );
    for (const topic of ['/farpoint/captured', '/odom', '/tf', '/farpoint/telemetry'])
      viewer.subscribe(topic);
    const clouds = await viewer.until('/farpoint/captured', 5);
    for (const { message, ns } of clouds) {
      const { width, height, header, data } = pointCloud2Schema.parse(message);
      expect([width, height, data.length]).toEqual([256, 256, 256 * 256 * 16]);
      expect(stampNs(header.stamp)).toBe(ns);
      expect(Math.abs(Number(ns / 1_000_000n) - Date.now())).toBeLessThan(60_000);
    }
    for (const topic of ['/odom', '/farpoint/telemetry', '/tf']) await viewer.until(topic, 5);
    const tf = z.object({ transforms: z.array(z.object({ child_frame_id: z.string() })) });
    const frames = viewer.received
      .get('/tf')
      ?.map(({ message }) => tf.parse(message).transforms[0]?.child_frame_id);
    expect(new Set(frames)).toEqual(new Set(['base_link', 'camera_optical_frame']));
    // Nothing was sent to an operator.
    viewer.subscribe('/farpoint/sent');
    await viewer.until('/farpoint/captured', clouds.length + 5);
    expect(viewer.received.has('/farpoint/sent')).toBe(false);
    expect(viewer.errors).toEqual([]);
  });

  it.skipIf(!hasVideo)(
    `shows video, encoded only while somebody subscribes (needs: ${BUILD_REMEDY})`,
    async () => {
      const viewer = await connect();
      const rate = () => metric('video_bits_per_second{camera="Front"}');
      await viewer.until('/odom', 0);
      expect(await rate()).toBe(0);
      const id = viewer.subscribe('/farpoint/videos/Front');
      const frames = await viewer.until('/farpoint/videos/Front', 20);
      const parsed = frames.map(({ message }) => foxgloveCompressedVideoSchema.parse(message));
      expect(parsed.every(({ format }) => format === 'h264')).toBe(true);
      // It begins with parameter sets.
      expect(Buffer.from(parsed[0]!.data).includes(SPS)).toBe(true);
      // One who comes later begins with a key frame, too.
      const second = await connect();
      second.subscribe('/farpoint/videos/Front');
      const [first] = await second.until('/farpoint/videos/Front', 1);
      const { data } = foxgloveCompressedVideoSchema.parse(first?.message);
      expect(Buffer.from(data).includes(SPS)).toBe(true);
      second.close();
      viewer.unsubscribe(id);
      await vi.waitFor(async () => expect(await rate()).toBe(0), { timeout: 20_000, interval: 100 });
    },
  );

  it('shows quantities, alarms and diagnostics', async () => {
    const viewer = await connect();
    const [left, charge] = ['/farpoint/quantities/motors_left', '/farpoint/alarms/charge'];
    await vi.waitFor(() => expect(viewer.channels.has('/diagnostics')).toBe(true), { timeout: 20_000 });
    for (const topic of [left, charge, '/diagnostics']) viewer.subscribe(topic);
    const [sample] = await viewer.until(left, 5);
    expect(sampleRecordSchema.parse(sample?.message).value).toBeCloseTo(22, 0);
    // Raised alarms are repeated for those who come later.
    const [alarm] = await viewer.until(charge, 1);
    expect(alarmRecordSchema.parse(alarm?.message)).toMatchObject({ level: 'warn', limit: 20, unit: '%' });
    const [array] = await viewer.until('/diagnostics', 1);
    expect(new DiagnosticBoard().take(array?.message, 0).status).toHaveLength(4);
    expect(viewer.errors).toEqual([]);
  });

  it('an operator’s clouds and commands appear as well', async () => {
    const viewer = await connect();
    for (const topic of ['/farpoint/sent', '/farpoint/commands']) viewer.subscribe(topic);
    const { client } = await robot.connect();
    const lease = await client.takeLease();
    const timer = setInterval(() => client.drive(lease, 0.1), 20);
    const clouds = await viewer.until('/farpoint/sent', 5);
    expect(clouds.some(({ message }) => pointCloud2Schema.parse(message).width === 600)).toBe(true);
    // Before the hand has let go once, they are refused, which appears as well.
    const accepted = async () =>
      (await viewer.until('/farpoint/commands', 5)).some(
        ({ message }) => (message as { accepted?: boolean } | null)?.accepted === true,
      );
    await expect.poll(accepted, { timeout: 10_000 }).toBe(true);
    clearInterval(timer);
  });

  it('counts who connects, and who tries to change something', async () => {
    const rude = new WebSocket(`ws://127.0.0.1:${port}`, ['foxglove.sdk.v1']);
    onTestFinished(() => rude.terminate());
    await once(rude, 'message');
    expect(await metric('foxglove_clients')).toBeGreaterThan(0);
    rude.send(Uint8Array.of(1, 1, 0, 0, 0, 9, 9, 9));
    await eventually(async () => (await metric('foxglove_refused_total{reason="binary"}')) === 1);
  });
});
