import { readFileSync } from 'node:fs';
import { knownFrame, readKnownFrame } from '../frames.ts';
import { ReferenceRobot } from '../peers/reference-robot.ts';
import { SocketPeer } from '../peers/socket-peer.ts';
import { type ConformanceCase, must } from './suite.ts';

/** A bridge, and the robots' port of the signaling at which it is a client. No other robot is there. */
export interface BridgeTarget {
  robot: string;
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

/** A page and robots of these names, the first of them shown. */
function withRobots(
  names: readonly string[],
  run: (robots: ReferenceRobot[], page: Page) => Promise<void>,
): ConformanceCase<BridgeTarget>['run'] {
  return async (target) => {
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
      const robots: ReferenceRobot[] = [];
      for (const name of names) {
        const robot = await ReferenceRobot.register(target.robot, name);
        closers.push(() => robot.close());
        robots.push(robot);
        const like = { type: 'updateRobots', robots: robots.map(({ id }) => ({ id })) };
        page.control.send({ type: 'updateRobots' });
        await page.control.message(like);
        if (robots.length > 1) await robot.heard('stop');
        else {
          page.control.send({ type: 'switchRobot', robotId: robot.id });
          await robot.heard('start');
        }
      }
      await run(robots, page);
    } finally {
      for (const close of closers.reverse()) await close();
    }
  };
}

const vectorCases = frames.map(
  ({ name, payloads, messages }): ConformanceCase<BridgeTarget> => ({
    name: `frames: ${name}`,
    run: withRobots(['conformance'], async ([robot], { streaming }) => {
      robot?.sendFrame(payloads.map((hex) => Buffer.from(hex, 'hex')));
      for (const hex of messages) {
        const message = Buffer.from(await streaming.bytes(5000)).toString('hex');
        must(
          message === hex,
          `a message of ${message.length / 2} bytes, another one of ${hex.length / 2} expected`,
        );
      }
    }),
  }),
);

export const bridgeSuite: readonly ConformanceCase<BridgeTarget>[] = [
  ...vectorCases,
  {
    name: 'shows one robot, goes over to another at once, and shows no other meanwhile',
    run: withRobots(['first', 'second'], async (robots, { control, streaming }) => {
      const [first, second] = robots as [ReferenceRobot, ReferenceRobot];
      first.sendFrame(knownFrame(1, 300));
      must(readKnownFrame(await streaming.bytes(5000)).frame === 1, 'not the first robot’s frame');
      control.send({ type: 'switchRobot', robotId: second.id });
      await control.message({ type: 'switchedRobot', robotId: second.id });
      await first.heard('stop');
      await second.heard('start');
      // One that does not heed the word.
      first.sendFrame(knownFrame(2, 300));
      second.sendFrame(knownFrame(3, 300));
      const { frame, places, strays } = readKnownFrame(await streaming.bytes(5000));
      must(frame === 3 && places.length === 300 && strays === 0, `frame ${frame}, ${places.length} points`);
    }),
  },
  {
    name: 'passes commands on as they are, and reports a rate for each frame',
    run: withRobots(['conformance'], async ([robot], { telemetry, streaming }) => {
      const command = { linear: { x: 0.25, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0.5 } };
      telemetry.send({ type: 'command', command });
      const came = await (robot as ReferenceRobot).command();
      must(JSON.stringify(came) === JSON.stringify(command), JSON.stringify(came));
      for (let frame = 0; frame < 3; frame++) {
        robot?.sendFrame(knownFrame(frame, 300));
        await streaming.bytes(5000);
        must(((await robot?.report()) ?? -1) > 0, 'a report that is no rate');
      }
    }),
  },
  {
    name: 'lives through offers that are none, garbage on its sockets and commands for nobody',
    run: withRobots(['conformance'], async ([robot], { control, telemetry, streaming }) => {
      for (const peer of [control, telemetry, streaming])
        for (const data of ['null', '{', '{"type":"switchRobot","robotId":"x"}', new Uint8Array([0xff, 0])])
          peer.sendRaw(data);
      const bad = await SocketPeer.open((robot as ReferenceRobot).url);
      bad.send({ type: 'register', name: 'bad', sdpOffer: 'v=0\r\nm=nonsense' });
      await bad.message({ type: 'registered' });
      control.send({ type: 'switchRobot', robotId: 0xffffffff });
      robot?.sendFrame(knownFrame(1, 300));
      must(readKnownFrame(await streaming.bytes(5000)).frame === 1, 'another frame');
      await bad.close();
    }),
  },
];
