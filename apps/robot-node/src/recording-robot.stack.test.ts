/** The robot program recording, and then playing the recording: processes, signaling, WebRTC. */
import { mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import { openRecording } from '@farpoint/recording';
import { foxgloveCompressedImageSchema } from '@farpoint/ros';
import { afterAll, describe, expect, it } from 'vitest';
import * as z from 'zod';
import { SignaledOperator } from './testing/signaled-operator.ts';

const RECORDED = 'recorded-1';
const PLAYED = 'played-1';
const folder = mkdtempSync(join(tmpdir(), 'farpoint-recording-robot-'));
const path = join(folder, 'drive.mcap');
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const PICTURES = '/farpoint/pictures/Camera';
const cloudSchema = z.object({ width: z.int(), height: z.int(), point_step: z.literal(16) });

async function withRobot(id: string, options: string[], use: (operator: SignaledOperator) => Promise<void>) {
  // This test does not check how much a busy computer lets through.
  const args = [...options, '--rate-control', 'fixed'];
  const stack = await LocalStack.start({ robots: [{ id, name: 'Robot', args }] });
  try {
    const operator = await SignaledOperator.connect(stack.signalingUrl, id);
    await use(operator);
    await operator.close();
  } finally {
    await stack.stop();
  }
}

describe('robot process that records', { timeout: 60_000 }, () => {
  it('records clouds as captured and as sent, pictures, commands, telemetry, estimates and latencies', async () => {
    const args = ['--sim-size', '64', '--max-points', '600', '--record', path, '--record-captured-fps', '10'];
    args.push('--record-clouds', 'both', '--record-sent-fps', '120', '--pictures-of-cloud');
    const seen: Uint8Array[] = [];
    await withRobot(RECORDED, args, async ({ client }) => {
      expect(await client.message('cameras')).toMatchObject({ cameras: [{ name: 'Camera' }] });
      client.sendSession({ type: 'pictures', cameras: [0] });
      await client.until(() => {
        const { bytes } = client.pictures.get(0) ?? {};
        if (bytes !== undefined && bytes !== seen.at(-1)) seen.push(bytes);
        return seen.length >= 3;
      });
      const lease = await client.takeLease();
      await client.until(() => client.telemetry !== null);
      const start = client.telemetry?.pose.position.x ?? 0;
      const timer = setInterval(() => client.drive(lease, 0.3), 20);
      await client.until(() => (client.telemetry?.pose.position.x ?? 0) > start + 0.3);
      clearInterval(timer);
      client.sendSession({ type: 'latencyMeasured', id: 1, frameNumber: 7, mtpMs: 98.5, firstMs: 91 });
      // A command without a lease is refused.
      client.drive('0'.repeat(32), 0.3);
      await client.until(() => client.telemetry?.drive === 'watchdog');
    });
    const recording = await openRecording(path);
    expect(recording.warning).toBeNull();
    const topics = new Map(recording.topics.map((topic) => [topic.name, topic]));
    const messagesOf = (name: string) => topics.get(name)?.messages ?? 0;
    const [captured, sent] = [messagesOf('/farpoint/captured'), messagesOf('/farpoint/sent')];
    expect(captured).toBeGreaterThan(5);
    expect(sent).toBeGreaterThan(captured);
    // Of the frame that is being sent when the robot ends, there may be only one of the two.
    expect(Math.abs(messagesOf('/farpoint/latencies') - sent)).toBeLessThanOrEqual(1);
    for (const name of ['/farpoint/telemetry', '/farpoint/estimates', '/farpoint/cmd_vel', '/odom', '/tf'])
      expect(messagesOf(name), name).toBeGreaterThan(5);

    // Every point that was sent is in the recording.
    const [sentPoints, toldPoints]: [number[], number[]] = [[], []];
    const verdicts = { accepted: 0, refused: 0 };
    const measured: unknown[] = [];
    const pictures: Buffer[] = [];
    const audited: unknown[] = [];
    for await (const { topic, data } of recording.messages([...topics.keys()], recording.startNs)) {
      const message = topic.decode(data);
      if (topic.name === '/farpoint/captured') {
        expect(cloudSchema.parse(message)).toMatchObject({ width: 64, height: 64 });
      } else if (topic.name === '/farpoint/sent') {
        sentPoints.push(cloudSchema.parse(message).width);
      } else if (topic.name === PICTURES) {
        const { data: file, format, frame_id } = foxgloveCompressedImageSchema.parse(message);
        expect([format, frame_id]).toEqual(['jpeg', 'camera_optical_frame']);
        pictures.push(Buffer.from(file));
      } else if (topic.name === '/farpoint/latencies') {
        toldPoints.push(z.object({ points: z.int() }).parse(message).points);
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
    const both = Math.min(sentPoints.length, toldPoints.length);
    expect(sentPoints.slice(0, both)).toEqual(toldPoints.slice(0, both));
    expect(sentPoints).toContain(600);
    expect(verdicts.accepted).toBeGreaterThan(10);
    expect(verdicts.refused).toBeGreaterThan(0);
    const subject = { name: 'test operator', proven: false };
    expect(audited.slice(0, 2)).toMatchObject([
      { kind: 'session-began', subject },
      { kind: 'lease-given', subject },
    ]);
    expect(measured).toMatchObject([{ id: 1, frameNumber: 7, mtpMs: 98.5, firstMs: 91 }]);
    await recording.close();
  });

  it('plays a recording at its recorded poses, with the configured pictures and readings', async () => {
    const config = join(folder, 'farpoint.yaml');
    const entries = [
      { topic: PICTURES, as: 'picture', label: 'Front' },
      { topic: '/farpoint/telemetry', as: 'text', type: 'std_msgs/String', label: 'Drive' },
    ];
    writeFileSync(config, JSON.stringify({ robot: { topics: entries } }));
    const args = ['--config', config, '--source', 'recording', '--path', path];
    args.push('--play-rate', '2', '--max-points', '300');
    await withRobot(PLAYED, args, async ({ client }) => {
      expect(await client.message('cameras')).toMatchObject({ cameras: [{ name: 'Front' }] });
      client.sendSession({ type: 'pictures', cameras: [0] });
      await client.until(() => client.pictures.has(0));
      expect(client.pictures.get(0)).toMatchObject({ format: 'jpeg', width: 64, height: 64 });
      await client.until(() => client.readings.has('/farpoint/telemetry'));
      expect(client.readings.get('/farpoint/telemetry')).toMatchObject({ label: 'Drive', level: 'ok' });
      await client.until(() => client.completeFrames.length >= 10);
      expect(client.malformedPackets).toBe(0);
      expect(client.completeFrames.every((frame) => frame.points === 300)).toBe(true);
      // The robot's pose is the recorded one: it moves although nobody drives.
      await client.until(() => (client.telemetry?.twist.linear.x ?? 0) > 0.2);
    });
  });

  it('begins and ends recordings for who drives, one after another, with bookmarks', async () => {
    const demanded = join(folder, 'demanded');
    mkdirSync(demanded);
    const config = join(folder, 'demanded.yaml');
    const mark = { id: 'mark', label: 'Mark', holdsLease: false, perSecond: 10, record: 'bookmark' };
    writeFileSync(config, JSON.stringify({ robot: { commands: [mark] } }));
    const args = ['--config', config, '--sim-size', '64', '--max-points', '300', '--record-folder', demanded];
    args.push('--record-sent-fps', '120');
    const files = () => readdirSync(demanded).sort();
    await withRobot(RECORDED, args, async ({ client }) => {
      expect((await client.message('about')).recorded).toBe(false);
      let request = 0;
      const call = async (id: string) => {
        const number = ++request;
        client.sendSession({ type: 'callCommand', id, request: number, timeMs: performance.now() });
        return await client.message('commandAnswer', (answer) => answer.request === number);
      };
      expect(await call('record')).toMatchObject({ outcome: 'refused', reason: 'not-driver' });
      await client.takeLease();
      expect(await call('mark')).toMatchObject({ outcome: 'failed', detail: 'nothing is being recorded' });
      const begun = await call('record');
      expect(begun).toMatchObject({ outcome: 'done', detail: expect.stringMatching(/\.mcap$/) });
      expect((await client.message('about', ({ recorded }) => recorded)).recorded).toBe(true);
      expect(files()).toEqual([begun.detail]);
      const frames = client.completeFrames.length;
      await client.until(() => client.completeFrames.length > frames + 5);
      expect(await call('mark')).toMatchObject({ outcome: 'done', detail: 'number 1' });
      expect(await call('record-stop')).toMatchObject({
        ...{ outcome: 'done', detail: `${begun.detail} is complete` },
      });
      await client.message('about', ({ recorded }) => !recorded);
      // Another, which the robot completes when it ends.
      // At most one a second. Asked all the time, the robot would drop what comes too often, without an answer.
      do {
        const { length } = client.completeFrames;
        await client.until(() => client.completeFrames.length > length);
      } while ((await call('record')).outcome !== 'done');
      await client.until(() => files().length === 2);
    });
    for (const [i, name] of files().entries()) {
      const recording = await openRecording(join(demanded, name));
      expect(recording.warning).toBeNull();
      const counts = Object.fromEntries(recording.topics.map(({ name, messages }) => [name, messages]));
      expect(counts['/farpoint/bookmarks']).toBe(1 - i);
      expect(counts['/farpoint/telemetry']).toBeGreaterThan(i === 0 ? 1 : -1);
      if (i === 0) expect(counts['/farpoint/sent']).toBeGreaterThan(2);
      await recording.close();
    }
  });

  it('refuses to overwrite an existing recording, and says so', async () => {
    const args = ['--sim-size', '64', '--record', path];
    await expect(withRobot(RECORDED, args, async () => {})).rejects.toThrow();
  });
});
