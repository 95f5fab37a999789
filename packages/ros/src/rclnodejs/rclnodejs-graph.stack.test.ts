/** Graphs through rclnodejs, in the sourced ROS 2 installation. */
import { execFileSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { eventually } from '@farpoint/service/testing/eventually';
import { testFolder } from '@farpoint/service/testing/folder';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { RosFault } from '../fault.ts';
import { RELIABLE_QOS } from '../graph.ts';
import { findRclnodejs, isSourced } from './environment.ts';
import { RclnodejsGraph } from './rclnodejs-graph.ts';

const STRING = 'std_msgs/msg/String';
const entry = isSourced(process.env) ? findRclnodejs() : null;
const now = () => performance.now();
/** std_msgs/String in little-endian CDR, padded to `size` bytes. */
function text(size: number): Uint8Array {
  const bytes = new Uint8Array(size);
  bytes[1] = 1;
  new DataView(bytes.buffer).setUint32(4, size - 8, true);
  for (let i = 8; i < size - 1; i++) bytes[i] = 97 + ((i * 7) % 26);
  return bytes;
}

it('without a binary, reports a fault and builds nothing', async () => {
  const folder = testFolder();
  const module = join(folder, 'node_modules', 'rclnodejs');
  mkdirSync(module, { recursive: true });
  writeFileSync(join(module, 'package.json'), '{"main":"index.js"}');
  writeFileSync(join(module, 'index.js'), 'throw new Error("it was run")');
  const opened = RclnodejsGraph.open({
    name: 'test',
    entry: join(module, 'index.js'),
    now,
    env: { PATH: '' },
  });
  await expect(opened).rejects.toMatchObject({
    code: 'unavailable',
    what: 'rclnodejs has no binary for this ROS',
    remedy: expect.stringContaining('npm rebuild rclnodejs') as string,
  });
});

describe.skipIf(entry === null)(
  'graphs by rclnodejs (needs a sourced ROS 2, and rclnodejs along NODE_PATH)',
  () => {
    let [ours, theirs] = [] as unknown as [RclnodejsGraph, RclnodejsGraph];
    let faults: RosFault[];
    const open = (name: string) =>
      RclnodejsGraph.open({
        ...{ name: `${name}_${process.pid}`, entry: entry ?? '', now },
        ...{ domain: 1 + (process.pid % 100), localhostOnly: true },
      });
    beforeEach(async () => {
      [ours, theirs] = await Promise.all([open('ours'), open('theirs')]);
      faults = [];
      ours.onFault = (fault) => faults.push(fault);
    }, 60_000);
    afterEach(async () => {
      await ours.close();
      await theirs.close();
    });

    it('bytes arrive unchanged, whatever their size', async () => {
      const heard: number[] = [];
      let sound = true;
      const to = { topic: '/a', type: STRING, queue: 16, qos: { ...RELIABLE_QOS, depth: 16 } };
      const subscription = ours.subscribe(to, (bytes, receivedMs) => {
        heard.push(bytes.length);
        sound &&= Buffer.compare(bytes, text(bytes.length)) === 0 && Math.abs(now() - receivedMs) < 1000;
      });
      const publisher = theirs.advertise({ topic: '/a', type: STRING, qos: { ...RELIABLE_QOS, depth: 16 } });
      await eventually(() => publisher.subscribers === 1 && subscription.publishers === 1);
      // RTPS pads sizes that are not multiples of four bytes.
      const sizes = [12, 16, 4096, 300_004, 5_000_000, 12];
      for (const size of sizes) publisher.publish(text(size));
      await eventually(() => heard.length === sizes.length);
      expect(heard).toEqual(sizes);
      expect(sound).toBe(true);
      await eventually(() => subscription.received === sizes.length);
      expect(subscription.dropped).toBe(0);
      await eventually(() => ours.topics().some(({ topic }) => topic === '/a'));
      expect(ours.topics().find(({ topic }) => topic === '/a')).toEqual({
        ...{ topic: '/a', type: STRING, publishers: 1, subscribers: 0 },
      });
      publisher.close();
      await eventually(() => subscription.publishers === 0);
    }, 60_000);

    it('a missing type is a fault with its topic', async () => {
      ours.subscribe({ topic: '/b', type: 'nobody_msgs/msg/Nothing', queue: 1 }, () => undefined);
      await eventually(() => faults.length > 0);
      expect(faults[0]).toMatchObject({ code: 'unsupported', topic: '/b' });
    }, 60_000);

    it('restarts a process that was killed, and receives again', async () => {
      const heard: number[] = [];
      ours.subscribe({ topic: '/c', type: STRING, queue: 4, qos: RELIABLE_QOS }, (bytes) =>
        heard.push(bytes.length),
      );
      const publisher = theirs.advertise({ topic: '/c', type: STRING });
      await eventually(() => publisher.subscribers === 1);
      const child = execFileSync('pgrep', ['-f', `"name":"ours_${process.pid}"`], { encoding: 'utf8' });
      process.kill(Number(child.split('\n')[0]), 'SIGKILL');
      await eventually(() => faults.length > 0);
      expect(faults[0]).toMatchObject({ code: 'lost', what: expect.stringContaining('SIGKILL') as string });
      const timer = setInterval(() => publisher.publish(text(20)), 50);
      await eventually(() => heard.length > 0);
      clearInterval(timer);
      expect(heard[0]).toBe(20);
    }, 60_000);

    it('sends the last message before it ends', async () => {
      const heard: number[] = [];
      ours.subscribe({ topic: '/d', type: STRING, queue: 4, qos: RELIABLE_QOS }, (bytes) =>
        heard.push(bytes.length),
      );
      const publisher = theirs.advertise({ topic: '/d', type: STRING });
      await eventually(() => publisher.subscribers === 1);
      publisher.publish(text(30));
      publisher.close();
      await theirs.close();
      await eventually(() => heard.length === 1);
    }, 60_000);
  },
);
