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
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { Bridge } from './bridge.ts';
import { openBridge } from './testing/open-bridge.ts';

const cleanups: (() => unknown)[] = [];
let stack: LocalStack;
beforeEach(async () => {
  stack = await LocalStack.start({ robots: [] });
  cleanups.push(() => stack.stop());
}, 30_000);
afterEach(async () => {
  for (const cleanup of cleanups.splice(0).reverse()) await cleanup();
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

async function bridge(): Promise<{ made: Bridge; streaming: SocketPeer; control: SocketPeer }> {
  const made = await openBridge(stack.ports.referenceClient);
  cleanups.push(() => made.close());
  const open = async (port: number) => {
    const peer = await SocketPeer.open(`ws://127.0.0.1:${port}/`);
    cleanups.push(() => peer.close());
    return peer;
  };
  return { made, streaming: await open(made.ports.streaming), control: await open(made.ports.control) };
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
    while (frames.length < 60) frames.push(readKnownFrame(await streaming.bytes()));
    stop();
    expect(link.packets).toBeGreaterThan(60 * 20);
    for (const [i, { frame, places, strays }] of frames.entries()) {
      expect(strays).toBe(0);
      expect(new Set(places).size).toBe(places.length);
      // In order within each frame, and frame after frame.
      expect(places.every((place, at) => at === 0 || place > (places[at - 1] as number))).toBe(true);
      if (i > 0) expect(frame).toBe((frames[i - 1] as ReadFrame).frame + 1);
    }
    const received = frames.reduce((sum, { places }) => sum + places.length, 0);
    const { shown: connection } = made.roster;
    // Two in a hundred were lost. All of them are sent again; on a busy machine, some too late for their frames.
    expect(received / (frames.length * points)).toBeGreaterThan(0.97);
    expect(connection?.packetsRecovered).toBeGreaterThan(10);
    // Every point that arrived in time was sent to the page.
    const { drops } = connection!.assembler;
    expect(Object.keys(drops).filter((reason) => reason !== 'duplicate' && reason !== 'late')).toEqual([]);
  });

  it('keeps showing its robot while signaling is down, and finds it again by name', async () => {
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
    const { made, control } = await bridge();
    await shown.heard('start');
    await shown.close();
    await control.message({ type: 'updateRobots', robots: null });
    expect(made.roster.size).toBe(0);
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
    for (let i = 0; i < 30; i++) {
      const { frame, places, strays } = await nextFrame(streaming, 100);
      expect([frame > last, places.length, strays]).toEqual([true, 600, 0]);
      last = frame;
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
    for (let i = 0; i < 100; i++) await nextFrame(streaming, 0);
    stop();
    expect(made.framesUnsent).toBeGreaterThan(0);
    expect(process.memoryUsage().arrayBuffers - before).toBeLessThan(64e6);
  });
});
