/**
 * The robot program plays a recording: clouds at the recorded poses, pictures and readings as configured, and what the
 * robot told about itself, marked as recorded.
 */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { openRecording } from '@farpoint/recording';
import { foxgloveCompressedImageSchema } from '@farpoint/ros';
import { useFolder } from '@farpoint/service/testing/folder';
import { beforeAll, describe, expect, it } from 'vitest';
import { makeRecording, SIDE, SPEED, valueOfSample } from './testing/made-recording.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'played-1';
const folder = useFolder();
const path = join(folder, 'drive.mcap');
const config = join(folder, 'farpoint.yaml');
const PICTURES = '/farpoint/pictures/Camera';
/** The files of the recording, base64. */
async function recordedPictures(): Promise<Set<string>> {
  const recording = await openRecording(path);
  const files = new Set<string>();
  for await (const { topic, data } of recording.messages([PICTURES], recording.startNs))
    files.add(Buffer.from(foxgloveCompressedImageSchema.parse(topic.decode(data)).data).toString('base64'));
  await recording.close();
  return files;
}

beforeAll(async () => {
  await makeRecording(path);
  const entries = [
    { topic: PICTURES, as: 'picture', label: 'Front' },
    { topic: '/farpoint/pictures/Rear', as: 'picture', label: 'Rear' },
    { topic: '/farpoint/telemetry', as: 'text', type: 'std_msgs/String', label: 'Drive' },
  ];
  writeFileSync(config, JSON.stringify({ robot: { topics: entries } }));
});

const PLAYS = ['--source', 'recording', '--path', path, '--max-points', '300', '--rate-control', 'fixed'];
const robot = useRobot(ROBOT, ['--config', config, ...PLAYS]);

describe('a robot that plays a recording', { timeout: 30_000 }, () => {
  it('sends its clouds and pictures, and is where it was', async () => {
    const { client } = await robot.connect();
    expect((await client.message('cameras')).cameras).toEqual([{ name: 'Front' }, { name: 'Rear' }]);
    client.sendSession({ type: 'pictures', cameras: [0, 1] });
    const seen = new Map<number, Uint8Array>();
    await client.until(() => {
      const picture = client.pictures.get(0);
      if (picture !== undefined) seen.set(picture.pictureId, picture.bytes);
      return seen.size >= 3;
    });
    expect(client.pictures.get(0)).toMatchObject({ format: 'jpeg', width: SIDE, height: SIDE });
    // At a rate that carries them, they are the recorded files, byte for byte.
    const files = await recordedPictures();
    for (const bytes of seen.values()) expect(files.has(Buffer.from(bytes).toString('base64'))).toBe(true);
    // A camera that the recording lacks is silent, and does not prevent playback.
    expect(client.pictures.has(1)).toBe(false);
    await client.until(() => client.readings.has('/farpoint/telemetry'));
    expect(client.readings.get('/farpoint/telemetry')).toMatchObject({ label: 'Drive', level: 'ok' });
    await client.until(() => client.completeFrames.length >= 5);
    expect(client.malformedPackets).toBe(0);
    expect(client.completeFrames.every((frame) => frame.points === 300)).toBe(true);
    // It moves although nobody drives.
    await client.until(() => Math.abs((client.telemetry?.twist.linear.x ?? 0) - SPEED) < 1e-6);
  });

  it('tells what it told about itself, marked as recorded', async () => {
    const { client } = await robot.connect();
    expect(await client.message('alarm')).toMatchObject({
      ...{ level: 'warn', limit: 20, unit: '%', recorded: true },
    });
    await client.until(() => client.newest.diagnostics !== undefined && client.samples.length >= 10);
    const quantities = client.session.filter((message) => message.type === 'quantity');
    expect(quantities.map(({ topic, field, recorded }) => `${topic} ${field} ${recorded}`)).toEqual([
      ...['/motors left true', '/motors right true'],
    ]);
    expect(client.newest.diagnostics).toMatchObject({
      ...{ topic: '/diagnostics', counts: { warn: 1, ok: 3 }, recorded: true },
    });
    const known = Array.from({ length: 30 }, (_, k) => valueOfSample(k));
    const values = client.samples.filter(([number]) => number === 0).map(([, , value]) => value);
    expect(values.length).toBeGreaterThan(0);
    for (const value of values) expect(known).toContain(value);
  });

  it('leaves that out with --play-beside videos', async () => {
    const args = [...PLAYS, '--play-beside', 'videos'];
    await robot.stack.startRobot({ id: 'played-2', name: 'Robot', args });
    const operator = robot.keep(await SignaledOperator.connect(robot.stack.signalingUrl, 'played-2'));
    const { client } = operator;
    // The other robot has told all of it by then.
    await client.until(() => client.completeFrames.length >= 10);
    const told = client.session.filter(({ type }) => type === 'quantity' || type === 'alarm');
    expect([told, client.samples, client.newest.diagnostics]).toEqual([[], [], undefined]);
    await robot.stack.robot('played-2').stop();
  });
});
