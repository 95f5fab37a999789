/** The bridge under faults: lossy links, a restarting service, robots that reconnect, flood or lie. */
import {
  knownFrame,
  type ReadFrame,
  ReferenceRobot,
  readKnownFrame,
  SocketPeer,
} from '@farpoint/conformance';
import { readCandidate, standIn, UdpLink } from '@farpoint/link-emulator';
import { LocalStack } from '@farpoint/local-stack';
import { idealProfile } from '@farpoint/network-sim';
import { eventually } from '@farpoint/service/testing/eventually';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import type { Bridge } from './bridge.ts';
import { openBridge } from './testing/open-bridge.ts';

const cleanups: (() => unknown)[] = [];
let stack: LocalStack;
beforeAll(async () => {
  stack = await LocalStack.start({ robots: [] });
}, 30_000);
afterAll(() => stack.stop(), 30_000);
afterEach(async () => {
  for (const cleanup of cleanups.splice(0).reverse()) await cleanup();
  // The next test's bridge shows the first robot that it finds.
  const line = await SocketPeer.open(`ws://127.0.0.1:${stack.ports.referenceClient}`);
  const listed = async () => {
    line.send({ type: 'getRobots' });
    return (await line.message<{ robots: object[] }>({ type: 'robots' })).robots;
  };
  while ((await listed()).length > 0);
  line.close();
}, 30_000);

async function robot(
  name: string,
  lead?: (side: 'robot' | 'operator', candidate: string) => Promise<string>,
) {
  const url = `ws://127.0.0.1:${stack.ports.referenceRobot}`;
  const made = await ReferenceRobot.register(url, name, lead === undefined ? {} : { lead });
  cleanups.push(() => made.close());
  return made;
}

async function bridge(): Promise<{ made: Bridge; streaming: SocketPeer }> {
  const made = await openBridge(stack.ports.referenceClient);
  cleanups.push(() => made.close());
  const streaming = await SocketPeer.open(`ws://127.0.0.1:${made.ports.streaming}/`);
  cleanups.push(() => streaming.close());
  return { made, streaming };
}

/** Sends frames numbered from `from`, 50 a second, until the returned function is called. */
function stream(sender: ReferenceRobot, from: number, points = 600): () => number {
  let frame = from;
  const timer = setInterval(() => sender.sendFrame(knownFrame(frame++, points)), 20);
  cleanups.push(() => clearInterval(timer));
  return () => {
    clearInterval(timer);
    return frame;
  };
}

/** The next frame with a number in this range. */
async function nextFrame(streaming: SocketPeer, from: number, to = from + 10_000): Promise<ReadFrame> {
  for (;;) {
    const read = readKnownFrame(await streaming.bytes());
    if (read.frame >= from && read.frame < to) return read;
  }
}

describe('bridge', { timeout: 30_000 }, () => {
  it('puts no point into a wrong frame or place, and none in twice, on a link that loses, reorders and duplicates packets', async () => {
    const profile = {
      ...idealProfile,
      delayMs: 2,
      loss: 0.02,
      reorder: { probability: 0.05, extraMs: 3 },
      duplicate: 0.05,
    };
    const link = new UdpLink({ up: { profile }, down: { profile: idealProfile }, seed: 5 });
    cleanups.push(() => link.close());
    const lead = async (side: 'robot' | 'operator', candidate: string) => {
      const read = readCandidate(candidate);
      return typeof read === 'string' ? candidate : standIn(read, await link.standInFor(side, read.endpoint));
    };
    const shown = await robot('shown', lead);
    const { made, streaming } = await bridge();
    await shown.heard('start');
    const points = 3000;
    const frames: ReadFrame[] = [];
    const stop = stream(shown, 0, points);
    while (frames.length < 40) frames.push(readKnownFrame(await streaming.bytes()));
    stop();
    expect(link.packets).toBeGreaterThan(40 * 20);
    for (const [i, { frame, places, strays }] of frames.entries()) {
      expect(strays).toBe(0);
      expect(new Set(places).size).toBe(places.length);
      // In order within each frame, and frame after frame.
      expect(places.every((place, at) => at === 0 || place > (places[at - 1] as number))).toBe(true);
      if (i > 0) expect(frame).toBeGreaterThan((frames[i - 1] as ReadFrame).frame);
    }
    // What was lost is sent again. That nothing is missing then: frame-assembler.test.ts.
    const { shown: connection } = made.roster;
    expect(connection?.packetsRecovered).toBeGreaterThan(0);
    // Every point that arrived in time was sent to the page.
    const { drops } = connection!.assembler;
    expect(Object.keys(drops).filter((reason) => reason !== 'duplicate' && reason !== 'late')).toEqual([]);
  });

  it('keeps showing its robot while signaling is down, and finds it again by name', async () => {
    // Ids begin anew.
    await stack.signaling.kill();
    await stack.startSignaling();
    const shown = await robot('shown');
    const { made, streaming } = await bridge();
    await shown.heard('start');
    const stop = stream(shown, 0);
    await nextFrame(streaming, 0);
    await stack.signaling.kill();
    await stack.startSignaling();
    // A robot with another name now has the old id.
    const other = await robot('other');
    expect(other.id).toBe(shown.id);
    await other.heard('stop');
    const reached = stop();
    shown.sendFrame(knownFrame(reached, 600));
    expect((await nextFrame(streaming, reached)).strays).toBe(0);
    // It comes back with another registration, but one connection is enough.
    const again = await robot('shown');
    await again.heard('start');
    again.sendFrame(knownFrame(20_000, 600));
    expect((await nextFrame(streaming, 20_000)).frame).toBe(20_000);
    expect(made.roster.size).toBe(2);
  });

  it('removes a robot when its registration and its points have both ended', async () => {
    const shown = await robot('shown');
    const { made } = await bridge();
    await shown.heard('start');
    await shown.close();
    await eventually(() => made.roster.size === 0);
  });

  it('accepts a new connection that its robot offers under the same id', async () => {
    const shown = await robot('shown');
    const { streaming } = await bridge();
    await shown.heard('start');
    shown.sendFrame(knownFrame(0, 600));
    await nextFrame(streaming, 0);
    await shown.reconnect();
    await shown.heard('start');
    // Frame numbers start at 0 again.
    shown.sendFrame(knownFrame(0, 300));
    expect((await nextFrame(streaming, 0)).places.length).toBe(300);
  });

  it('shows its robot while another floods it and ignores stop, and a third keeps registering', async () => {
    const shown = await robot('shown');
    const { made, streaming } = await bridge();
    await shown.heard('start');
    const flooder = await robot('flooder');
    await flooder.heard('stop');
    const flood = setInterval(() => {
      flooder.sendFrame(knownFrame(9, 60_000));
      flooder.signal({ type: 'candidate', robotId: flooder.id, candidate: 'candidate:nonsense' });
    }, 10);
    cleanups.push(() => clearInterval(flood));
    const restless = await SocketPeer.open(`ws://127.0.0.1:${stack.ports.referenceRobot}`);
    cleanups.push(() => restless.close());
    for (let i = 0; i < 20; i++) restless.send({ type: 'register', name: 'restless', sdpOffer: shown.offer });
    const stop = stream(shown, 100);
    let last = 99;
    // A flooded machine may lose packets of any robot.
    for (let whole = 0; whole < 10; ) {
      const { frame, places, strays } = await nextFrame(streaming, 100);
      expect([frame > last, strays]).toEqual([true, 0]);
      last = frame;
      if (places.length === 600) whole++;
    }
    stop();
    expect(made.roster.selected).toBe(shown.id);
    expect(made.roster.shown?.packetsRefused).toBe(0);
  });

  it('goes on when a page stops reading: that page misses frames, others do not', async () => {
    const shown = await robot('shown');
    const { made, streaming } = await bridge();
    const asleep = await SocketPeer.open(`ws://127.0.0.1:${made.ports.streaming}/`);
    cleanups.push(() => asleep.close());
    asleep.pause();
    await shown.heard('start');
    const before = process.memoryUsage().arrayBuffers;
    const stop = stream(shown, 0, 30_000);
    // The system's buffers of the page that sleeps are full some time.
    while (made.framesUnsent === 0) await nextFrame(streaming, 0);
    const unsent = made.framesUnsent;
    while (made.framesUnsent < unsent + 20) await nextFrame(streaming, 0);
    stop();
    expect(process.memoryUsage().arrayBuffers - before).toBeLessThan(64e6);
  });
});
