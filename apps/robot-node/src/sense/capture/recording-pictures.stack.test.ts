/** Pictures and readings from recordings, as shown by a robot that plays them. */
import { join } from 'node:path';
import type { SourcePicture } from '@farpoint/cloud-source';
import {
  cloudMessage,
  mcapOfTopics,
  POINT_CLOUD2_SCHEMA,
  START_NS,
  type TestTopic,
  writeFile,
} from '@farpoint/recording/testing';
import { Peers } from '@farpoint/recording/testing/peers';
import { type TopicReading, topicTableSchema } from '@farpoint/ros';
import { useFolder } from '@farpoint/service/testing/folder';
import { beforeAll, describe, expect, it, onTestFinished } from 'vitest';
import { RecordingSource } from '../sources/recording-source.ts';
import { Capture } from './capture.ts';

const folder = useFolder();

const [WIDTH, HEIGHT] = [8, 4];
const PLAY = { topic: '/points', rate: 100, fromS: 0, atEnd: 'stop', axes: 'auto' } as const;

/** Plays the recording to its end with a watcher for every camera. */
async function play(path: string, table: object[], { watched = true } = {}) {
  const now = () => performance.now();
  const source = await RecordingSource.open({ ...PLAY, path, topics: topicTableSchema.parse(table) }, now);
  onTestFinished(() => source.close());
  const pictures: SourcePicture[] = [];
  const readings: TopicReading[] = [];
  const faults: string[] = [];
  let clouds = 0;
  const { capacity, cameras = [] } = source.description;
  const room = {
    points: new Float32Array(capacity * 4),
    depth: new Float32Array(0),
    colour: new Uint32Array(0),
  };
  source.onFault = ({ message }) => faults.push(message);
  source.onReading = (reading) => readings.push(reading);
  source.usePictures({
    wants: () => true,
    offer: (picture) => pictures.push({ ...picture, data: picture.data.slice() }),
  });
  if (watched) source.watchPictures(cameras.map(() => 30));
  const wishes = { bitsPerSecond: 1e6, latencyTest: false };
  const ended = new Promise<void>((resolve) => {
    source.onEnd = resolve;
  });
  source.onReady = () => {
    if (source.capture(now(), wishes, room) !== null) clouds++;
  };
  source.start();
  await ended;
  return { source, pictures, readings, faults, clouds };
}

const peers = Peers.install();
describe.skipIf(typeof peers === 'string')(
  `pictures written by libraries from PyPI ${typeof peers === 'string' ? `(${peers})` : ''}`,
  { timeout: 60_000 },
  () => {
    beforeAll(() => (peers as Peers).writePictures(folder), 400_000);

    it.each([
      ['ros1.bag', '/raw', '/file/compressed'],
      ['ros1.mcap', '/raw', '/file/compressed'],
      ['ros2.mcap', '/raw', '/file/compressed'],
      ['foxglove.mcap', '/protobuf_raw', '/protobuf'],
      ['foxglove.mcap', '/protobuf_raw', '/json'],
    ])('%s: %s and %s, every one', async (file, raw, compressed) => {
      const { source, pictures, faults, clouds } = await play(join(folder, file), [
        { topic: raw, as: 'picture', label: 'Raw' },
        { topic: compressed, as: 'picture', most: 5 },
      ]);
      expect(faults).toEqual([]);
      expect(clouds).toBe(10);
      expect(source.description.cameras).toEqual([
        { name: 'Raw', most: null },
        { name: compressed, most: 5 },
      ]);
      const [ofRaw, ofCompressed] = [0, 1].map((camera) => pictures.filter((each) => each.camera === camera));
      expect(ofRaw).toHaveLength(10);
      ofRaw?.forEach(({ facts, data }, k) => {
        expect(facts).toEqual({
          ...{
            kind: 'raw',
            width: WIDTH,
            height: HEIGHT,
            step: WIDTH * 3,
            encoding: 'rgb8',
            bigEndian: false,
          },
        });
        expect([...data]).toEqual(Array.from({ length: WIDTH * HEIGHT }, () => [k * 20, 50, 100]).flat());
      });
      expect(ofCompressed).toHaveLength(10);
      for (const { facts, origin } of ofCompressed ?? []) {
        expect(facts).toEqual({ kind: 'file', format: 'png', width: WIDTH, height: HEIGHT });
        expect(origin).toMatch(new RegExp(`^${compressed}: byte \\d+$`));
      }
      const captured = pictures.map(({ capturedAtMs }) => capturedAtMs);
      expect(captured).toEqual(captured.toSorted((a, b) => a - b));
    });

    it.each(['ros1.bag', 'ros2.mcap'])(
      '%s: says which topics have pictures if the table names another; reads none while nobody watches',
      async (file) => {
        const { faults, pictures, clouds } = await play(
          join(folder, file),
          [
            { topic: '/raw', as: 'picture' },
            { topic: '/front', as: 'picture' },
            { topic: '/points', as: 'picture' },
            { topic: '/battery', as: 'battery' },
          ],
          { watched: false },
        );
        expect(clouds).toBe(10);
        expect(pictures).toEqual([]);
        expect(faults).toEqual([
          expect.stringMatching(
            /ros\d\.\w+: \/front: no such topic; with pictures: \/raw, \/file\/compressed$/,
          ),
          expect.stringMatching(/: \/points: its type is sensor_msgs\/msg\/PointCloud2, not pictures; /),
          expect.stringMatching(/: \/battery: no such topic$/),
        ]);
      },
    );
  },
);

describe('pictures and readings of a recording', () => {
  const at = (ms: number) => START_NS + BigInt(ms) * 1_000_000n;
  const text = (value: object) => new TextEncoder().encode(JSON.stringify(value));
  const clouds: TestTopic = {
    ...{ topic: '/points', type: 'sensor_msgs/msg/PointCloud2' },
    schema: POINT_CLOUD2_SCHEMA,
    messages: Array.from({ length: 20 }, (_, k) => ({ logNs: at(k * 100), data: cloudMessage(k, 3) })),
  };
  const json = { messageEncoding: 'json', schemaEncoding: 'jsonschema' };
  const raw = (k: number, more: object = {}) =>
    text({
      ...{ timestamp: { sec: 1, nsec: 0 }, frame_id: 'c', width: 2, height: 1, step: 6, encoding: 'rgb8' },
      data: Buffer.from([k, 1, 2, 3, 4, 5]).toString('base64'),
      ...more,
    });
  const write = async (name: string, topics: TestTopic[]) =>
    writeFile(join(folder, name), await mcapOfTopics([clouds, ...topics]));

  it('reports broken messages with file, topic and byte, once per fault, and plays the rest', async () => {
    const messages = Array.from({ length: 20 }, (_, k) => {
      const broken: (Uint8Array | undefined)[] = [];
      broken[3] = text({});
      broken[4] = text({});
      broken[7] = new TextEncoder().encode('{"width"');
      broken[9] = raw(9, { data: 'no base64!' });
      broken[12] = raw(12, { width: -1 });
      return { logNs: at(k * 100 + 50), data: broken[k] ?? raw(k) };
    });
    const files = [0, 1, 2].map((k) => ({
      logNs: at(k * 100 + 60),
      data: text({ timestamp: { sec: 1, nsec: 0 }, frame_id: '', format: 'webp', data: 'UklGRg==' }),
    }));
    const path = await write('broken.mcap', [
      { topic: '/camera', type: 'foxglove.RawImage', ...json, messages },
      { topic: '/web', type: 'foxglove.CompressedImage', ...json, messages: files },
    ]);
    const played = await play(path, [
      { topic: '/camera', as: 'picture' },
      { topic: '/web', as: 'picture' },
    ]);
    expect(played.clouds).toBe(20);
    expect(played.pictures.map(({ data }) => data[0])).toEqual(
      Array.from({ length: 20 }, (_, k) => k).filter((k) => ![3, 4, 7, 9, 12].includes(k)),
    );
    expect(played.faults).toHaveLength(5);
    for (const fault of played.faults) expect(fault).toMatch(/broken\.mcap: \/(camera|web): byte \d+: /);
    expect(played.faults.filter((fault) => fault.includes('neither JPEG nor PNG'))).toHaveLength(1);
  });

  it('reports readings as live ones are reported', async () => {
    const battery: TestTopic = {
      ...{ topic: '/battery', type: 'battery', ...json },
      messages: [10, 20].map((ms) => ({ logNs: at(ms), data: text({ voltage: 25.1, percentage: 0.75 }) })),
    };
    const own: TestTopic = {
      ...{ topic: '/farpoint/telemetry', type: '', ...json },
      messages: [10, 1500].map((ms) => ({ logNs: at(ms), data: text({ drive: 'standing', ms }) })),
    };
    const unnamed: TestTopic = { ...battery, topic: '/other' };
    const path = await write('readings.mcap', [battery, own, unnamed]);
    const { readings, faults } = await play(path, [
      { topic: '/battery', as: 'battery' },
      { topic: '/farpoint/telemetry', as: 'text', type: 'std_msgs/String', label: 'Own', most: 100 },
    ]);
    expect(faults).toEqual([]);
    expect(readings.map(({ label, values }) => [label, ...values.map(([, value]) => value)])).toEqual([
      ['Battery', '75 %', '25.1 V'],
      ['Own', 'standing', '10'],
      ['Own', 'standing', '1500'],
    ]);
  });

  it('the robot’s log, too, names topics that the recording lacks', { timeout: 20_000 }, async () => {
    const path = await write('nothing.mcap', []);
    const topics = topicTableSchema.parse([{ topic: '/front', as: 'picture' }]);
    const capture = await Capture.start({
      ...{ source: { kind: 'recording', ...PLAY, path, topics }, framesPerSecond: 20, plan: 'paper' },
      sampling: { lambda: 0, epsilon: 1e-6, nearDistance: 3.85 },
      ...{ floorFraction: 0.1, mostPoints: 1000, sensor: 0 },
    });
    const fault = await new Promise<string>((resolve) => {
      capture.onFault = resolve;
    });
    await capture.close();
    expect(capture.cameras).toEqual([{ name: '/front', most: null }]);
    expect(fault).toMatch(/nothing\.mcap: \/front: no such topic; with pictures: none$/);
  });
});
