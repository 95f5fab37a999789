/**
 * Every combination of theirs and ours: robot, signaling, bridge, page. Theirs are stand-ins that behave like the
 * released programs, including their defects. Ours are the real programs, except for the page: a stand-in that sends on
 * the bridge's sockets what our page sends.
 */
import { BridgeProcess, LocalStack } from '@farpoint/local-stack';
import { LATENCY_TEST_COLOUR, type Twist, zeroTwist } from '@farpoint/protocol';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { readKnownFrame } from '../frames.ts';
import { SocketPeer } from '../peers/socket-peer.ts';
import {
  type BridgeSockets,
  FarpointPage,
  ReleasedBridge,
  ReleasedPage,
  ReleasedRobot,
  ReleasedSignaling,
} from '../testing/index.ts';

const OURS = 'Ours';
const THEIRS = 'Theirs';
const POINTS = { [OURS]: 600, [THEIRS]: 300 };

interface Signaling {
  robotUrl: string;
  clientUrl: string;
}

interface ListedOffer {
  name: string;
  sdpAnswer: string | null;
}

let stack: LocalStack;
let released: ReleasedSignaling;
const robots = new Map<Signaling, ReleasedRobot>();
const signalings: Record<'ours' | 'theirs', Signaling> = {} as never;
const cleanups: (() => Promise<void>)[] = [];

beforeAll(async () => {
  stack = await LocalStack.start({ robots: [] });
  released = await ReleasedSignaling.start();
  signalings.ours = {
    robotUrl: `ws://127.0.0.1:${stack.ports.referenceRobot}`,
    clientUrl: `ws://127.0.0.1:${stack.ports.referenceClient}`,
  };
  signalings.theirs = released;
  for (const [id, signaling] of Object.entries(signalings)) {
    const args = ['--sim-size', '64', '--max-points', '650', '--reference-signaling', signaling.robotUrl];
    await stack.startRobot({ id: `robot-${id}`, name: OURS, args });
    await openOffer(signaling, OURS);
    robots.set(signaling, await ReleasedRobot.start(signaling.robotUrl, { name: THEIRS, offerAgainMs: 100 }));
  }
}, 60_000);
afterAll(async () => {
  for (const robot of robots.values()) await robot.stop();
  await released.stop();
  await stack.stop();
}, 30_000);
afterEach(async () => {
  for (const cleanup of cleanups.splice(0).reverse()) await cleanup();
}, 30_000);

/** Resolves once a robot with this name has an unanswered offer. */
async function openOffer(signaling: Signaling, name: string): Promise<void> {
  const client = await SocketPeer.open(signaling.clientUrl);
  const isOpen = (robot: ListedOffer) => robot.name === name && robot.sdpAnswer === null;
  client.send({ type: 'getRobots' });
  const { robots: listed } = await client.message<{ robots: ListedOffer[] }>({ type: 'robots' });
  if (!listed.some(isOpen)) await client.message({ type: 'register', robot: { name } });
  await client.close();
}

/**
 * @returns its sockets, and a promise that resolves once it may tell a robot to start: their bridge loses an earlier
 * word
 */
async function openBridge(
  whose: 'ours' | 'theirs',
  signaling: Signaling,
): Promise<{ sockets: BridgeSockets; ready: (name: string) => Promise<void> }> {
  if (whose === 'theirs') {
    const bridge = await ReleasedBridge.start();
    cleanups.push(() => bridge.stop());
    return { sockets: bridge.sockets, ready: (name) => bridge.ready(name) };
  }
  const bridge = await BridgeProcess.start(stack, { args: ['--signaling', signaling.clientUrl] });
  cleanups.push(() => bridge.stop());
  const at = (port: number) => `ws://127.0.0.1:${port}`;
  const { control, telemetry, streaming } = bridge.ports;
  const sockets = { control: at(control), telemetry: at(telemetry), streaming: at(streaming) };
  return { sockets, ready: async () => undefined };
}

type Page = FarpointPage | ReleasedPage;

async function expectPoints(page: Page, name: keyof typeof POINTS): Promise<void> {
  for (;;) {
    const message = await page.points();
    // A frame of the robot shown before; an empty one; or one whose first packet their bridge has swallowed.
    if (message.length !== 8 * POINTS[name]) continue;
    if (name === THEIRS && !isGreen(message)) expect(readKnownFrame(message).strays).toBe(0);
    return;
  }
}

async function expectGreen(page: Page, name: keyof typeof POINTS): Promise<void> {
  const twist = zeroTwist();
  twist.linear.z = 1;
  page.command(twist);
  for (;;) {
    const message = await page.points();
    // Their bridge does not request lost packets again.
    if (message.length > 0 && message.length <= 8 * POINTS[name] && isGreen(message)) return;
  }
}

function isGreen(message: Uint8Array): boolean {
  const view = new DataView(message.buffer, message.byteOffset, message.byteLength);
  for (let at = (message.length / 8) * 6; at < message.length; at += 2)
    if (view.getUint16(at, true) !== LATENCY_TEST_COLOUR) return false;
  return true;
}

async function expectDriven(page: Page, robot: ReleasedRobot): Promise<void> {
  const wish: Twist = { linear: { x: 0.25, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0.5 } };
  page.command(wish);
  const came = await robot.commands.next(({ linear }) => linear.x !== 0, undefined, 'a command');
  page.command(zeroTwist());
  expect(came).toEqual(wish);
}

describe.each(['ours', 'theirs'] as const)('signaling: %s', (whoseSignaling) => {
  describe.each(['ours', 'theirs'] as const)('bridge: %s', (whoseBridge) => {
    it('shows and drives both robots on both pages, also after a reload', { timeout: 60_000 }, async () => {
      const signaling = signalings[whoseSignaling];
      const robot = robots.get(signaling) as ReleasedRobot;
      await openOffer(signaling, OURS);
      const { sockets, ready } = await openBridge(whoseBridge, signaling);
      for (const load of [ReleasedPage.load, FarpointPage.load]) {
        const page: Page = await load(sockets, signaling.clientUrl);
        cleanups.push(() => page.close());
        for (let loads = 0; loads < 2; loads++) {
          for (const name of [OURS, THEIRS] as const) {
            await ready(name);
            await page.switchTo(name);
            await expectPoints(page, name);
            await expectGreen(page, name);
            if (name === THEIRS) await expectDriven(page, robot);
          }
          await page.reload();
        }
        await page.close();
        expect(page.errors).toEqual([]);
      }
      // Their robot must notice that its operator has left before another comes.
      const { offers } = robot;
      for (const cleanup of cleanups.splice(0).reverse()) await cleanup();
      await robot.offered.next((count) => count > offers, undefined, 'another offer of their robot');
    });
  });
});
