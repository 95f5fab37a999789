import { readFileSync } from 'node:fs';
import { knownFrame } from '../frames.ts';
import type { KnownDefect } from '../known-defects.ts';
import { ReferenceRobot } from '../peers/reference-robot.ts';
import { SocketPeer } from '../peers/socket-peer.ts';
import { nextPoints, showFrames } from './shown-frames.ts';
import { type ConformanceCase, type Level, must } from './suite.ts';

/** A bridge, and the signaling of which it is, or becomes, a client. No other robot is registered there. */
export interface BridgeTarget {
  /** Robots' port of signaling. */
  robot: string;
  /** Clients' port of the same signaling, as the bridge reaches it. */
  client: string;
  control: string;
  telemetry: string;
  streaming: string;
}

interface FrameVector {
  name: string;
  payloads: string[];
  messages: string[];
}

const { frames } = JSON.parse(
  readFileSync(new URL('../../vectors/frames.json', import.meta.url), 'utf8'),
) as { frames: FrameVector[] };

interface Page {
  control: SocketPeer;
  telemetry: SocketPeer;
  streaming: SocketPeer;
}

/** Bridges that were told where signaling is: the released one opens another connection each time. */
const initialised = new WeakSet<BridgeTarget>();

/** A page and robots with these names, connected; the first of them shown. */
function withRobots(
  names: readonly string[],
  run: (robots: ReferenceRobot[], page: Page, level: Level, target: BridgeTarget) => Promise<void>,
): ConformanceCase<BridgeTarget>['run'] {
  return async (target, level) => {
    const closers: (() => Promise<void>)[] = [];
    try {
      const open = async (url: string) => {
        const peer = await SocketPeer.open(url);
        closers.push(() => peer.close());
        return peer;
      };
      const page = {
        control: await open(target.control),
        telemetry: await open(target.telemetry),
        streaming: await open(target.streaming),
      };
      if (!initialised.has(target)) await initBridge(page.control, target);
      initialised.add(target);
      const robots: ReferenceRobot[] = [];
      for (const name of names) {
        const robot = await ReferenceRobot.register(target.robot, name);
        closers.push(() => robot.close());
        robots.push(robot);
      }
      // Messages to a channel that is not open may be lost.
      for (const robot of robots) await robot.ready();
      page.control.send({ type: 'updateRobots' });
      for (const { id } of robots) await listed(page.control, id);
      const [first, ...others] = robots as [ReferenceRobot, ...ReferenceRobot[]];
      await switchTo(page.control, first.id);
      await first.heard('start');
      for (const other of others) await other.heard('stop');
      await run(robots, page, level, target);
    } finally {
      for (const close of closers.reverse()) await close();
    }
  };
}

async function initBridge(control: SocketPeer, { client }: BridgeTarget): Promise<void> {
  control.send({ type: 'initBridge', url: client });
  await control.message({ type: 'updateRobots' });
}

/** Requests the list until it contains the robot. */
async function listed(control: SocketPeer, id: number): Promise<void> {
  for (;;) {
    control.send({ type: 'updateRobots' });
    const { robots } = await control.message<{ robots: { id: number }[] | null }>({ type: 'updateRobots' });
    if (robots?.some((robot) => robot.id === id)) return;
  }
}

async function switchTo(control: SocketPeer, robotId: number): Promise<void> {
  control.send({ type: 'switchRobot', robotId });
  await control.message({ type: 'switchedRobot', robotId });
}

/** Why the released bridge fails at a vector, by the vector's name. */
const VECTOR_DEFECTS: Readonly<Record<string, KnownDefect>> = {
  'a whole frame is given out without the next': 'frame-waits-for-next',
  'a last packet that is partial keeps its points': 'partial-block-lost',
  'packets of one frame in any order': 'order-of-arrival',
  'packets that come twice': 'doubled-points',
  'packets of two frames between each other': 'late-in-wrong-frame',
  'packets that cannot be are passed over': 'reads-what-is-no-packet',
};
/** Later than the frame numbers of any vector. */
const NEXT_FRAME = 1000;

const vectorCases = frames.map(({ name, payloads, messages }): ConformanceCase<BridgeTarget> => {
  const defect = VECTOR_DEFECTS[name];
  return {
    name: `frames: ${name}`,
    defect,
    run: withRobots(['conformance'], async ([robot], { streaming }, level) => {
      robot?.sendFrame(payloads.map((hex) => Buffer.from(hex, 'hex')));
      if (level === 'reference' && defect !== 'frame-waits-for-next')
        robot?.sendFrame(knownFrame(NEXT_FRAME, 150));
      for (const hex of messages) {
        const message = Buffer.from(await nextPoints(streaming, level, 2000)).toString('hex');
        must(
          message === hex,
          `a message of ${message.length / 2} bytes, another one of ${hex.length / 2} expected`,
        );
      }
    }),
  };
});

const DRIVE = { linear: { x: 0.25, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0.5 } };

async function passesCommands(robot: ReferenceRobot, telemetry: SocketPeer): Promise<void> {
  telemetry.send({ type: 'command', command: DRIVE });
  const came = await robot.commands.next(undefined, 2000, 'a command');
  must(JSON.stringify(came) === JSON.stringify(DRIVE), JSON.stringify(came));
}

export const bridgeSuite: readonly ConformanceCase<BridgeTarget>[] = [
  ...vectorCases,
  {
    name: 'shows one robot, switches to another at once, and shows no other meanwhile',
    run: withRobots(['first', 'second'], async (robots, { control, streaming }, level) => {
      const [first, second] = robots as [ReferenceRobot, ReferenceRobot];
      const shown = await showFrames(first, 1, 300, streaming, level);
      must(shown.frame < 1000 && shown.places.length === 300, `frame ${shown.frame}, not the first robot’s`);
      await switchTo(control, second.id);
      await first.heard('stop');
      await second.heard('start');
      // A robot that ignores the word.
      first.sendFrame(knownFrame(900, 300));
      for (;;) {
        const { frame, places, strays } = await showFrames(second, 2000, 300, streaming, level);
        // Frames given out before the switch may still be in transit.
        if (frame < 900) continue;
        must(
          frame >= 2000 && places.length === 300 && strays === 0,
          `frame ${frame}, ${places.length} points`,
        );
        return;
      }
    }),
  },
  {
    name: 'passes commands on unchanged, and reports a rate for each frame',
    run: withRobots(['conformance'], async ([robot], { telemetry, streaming }, level) => {
      await passesCommands(robot as ReferenceRobot, telemetry);
      for (let i = 0; i < 3; i++) {
        await showFrames(robot as ReferenceRobot, 100 * i, 300, streaming, level);
        must(((await robot?.report()) ?? -1) > 0, 'a report that is no rate');
      }
    }),
  },
  {
    name: 'survives garbage on its sockets',
    run: withRobots(['conformance'], async ([robot], { control, telemetry, streaming }, level) => {
      for (const peer of [control, telemetry, streaming])
        for (const data of ['null', '{', '{"type":"switchRobot","robotId":"x"}', new Uint8Array([0xff, 0])])
          peer.sendRaw(data);
      await showFrames(robot as ReferenceRobot, 1, 300, streaming, level);
      await passesCommands(robot as ReferenceRobot, telemetry);
    }),
  },
  {
    name: 'keeps showing its robot if a page selects one that does not exist',
    defect: 'shows-nobody',
    run: withRobots(['conformance'], async ([robot], { control, streaming }, level) => {
      control.send({ type: 'switchRobot', robotId: 0xffffffff });
      // Messages are answered in order, so everything earlier has been processed.
      control.send({ type: 'updateRobots' });
      await listed(control, (robot as ReferenceRobot).id);
      robot?.sendFrame(knownFrame(1, 300));
      robot?.sendFrame(knownFrame(2, 300));
      await nextPoints(streaming, level, 2000);
    }),
  },
  {
    name: 'drops a command for a robot whose channel is not open',
    defect: 'command-breaks-socket',
    run: withRobots(['conformance'], async ([robot], { control, telemetry }) => {
      const { url, offer, id } = robot as ReferenceRobot;
      const mute = await SocketPeer.open(url);
      try {
        mute.send({ type: 'register', name: 'mute', sdpOffer: offer });
        const { robotId } = await mute.message<{ robotId: number }>({ type: 'registered' });
        await mute.message({ type: 'sdpAnswer' });
        await switchTo(control, robotId);
        telemetry.send({ type: 'command', command: DRIVE });
        // The answer arrives after the bridge has read the command; if it has not, another command is lost.
        await switchTo(control, id);
        await robot?.heard('start');
        await passesCommands(robot as ReferenceRobot, telemetry);
      } finally {
        await mute.close();
      }
    }),
  },
  {
    name: 'answers each initBridge with the list, even for the address in use',
    run: withRobots(['conformance'], async ([robot], { control }, _level, target) => {
      for (let i = 0; i < 2; i++) {
        await initBridge(control, target);
        await listed(control, (robot as ReferenceRobot).id);
      }
    }),
  },
  {
    name: 'survives an invalid offer',
    defect: 'offer-ends-bridge',
    deadly: true,
    run: withRobots(['conformance'], async ([robot], { streaming }, level) => {
      const bad = await SocketPeer.open((robot as ReferenceRobot).url);
      bad.send({ type: 'register', name: 'bad', sdpOffer: 'v=0\r\nm=nonsense' });
      await bad.message({ type: 'registered' });
      await showFrames(robot as ReferenceRobot, 1, 300, streaming, level);
      await bad.close();
    }),
  },
];
