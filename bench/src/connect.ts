/** `pnpm bench connect`: how long it takes to establish a session. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ReferenceOperator } from '@farpoint/conformance';
import { grantTo, makeIssuer, type TestIssuer } from '@farpoint/grants/testing';
import { LocalStack, processFolder } from '@farpoint/local-stack';
import { type Credentials, SignaledOperator } from '@farpoint/robot-node/testing';
import { metricOf } from '@farpoint/robot-node/testing/metric-of';
import { shownGrant } from '@farpoint/robot-node/testing/shown-grant';
import { benchOptions, option } from './bench-options.ts';
import { BusyLoops } from './busy-loops.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench connect [--count 20] [--starts 5] [--busy 0] [--json]

Real signaling and robot (simulated office), each in its own process, without a network between them. An operator in this
process connects --count times in each profile, one after the other. It starts the DTLS handshake as soon as its own
connectivity checks succeed, which may be before the robot's do. Farpoint profile: from opening the signaling socket to the
robot's welcome; with a grant: at a robot that asks for one, with the proof that goes with it. Reference profile: from the
client port of signaling to the open data channels, once the robot's offer exists. Then everything is started anew --starts
times, and the first operator of a robot connects in each profile. --busy: so many busy loops run beside it.`;

const ROBOT = 'sim-1';
const GRANTED = 'sim-2';
const NAME = 'Simulated robot';
const OTHER_NAME = 'Another simulated robot';

const ARGS = ['--sim-size', '64'];
const ENV = { FARPOINT_LOG_LEVEL: 'warn' };

export const bench: Bench = {
  name: 'connect',
  summary: 'time from signaling to a session, in both profiles',
  usage: USAGE,
  async run(argv) {
    const { count, starts, busy, json } = benchOptions(argv, {
      count: option.number(20, { least: 1 }),
      starts: option.number(5),
      busy: option.number(0),
    });
    const folder = processFolder();
    const keys = join(folder, 'grant-keys.json');
    const issuer = await makeIssuer();
    writeFileSync(keys, JSON.stringify({ keys: [issuer.publicJwk] }));
    const stack = await LocalStack.start({
      robots: [
        { id: ROBOT, name: NAME, reference: true, args: ARGS },
        { id: GRANTED, name: NAME, args: [...ARGS, '--grant-keys', keys] },
      ],
      env: ENV,
    });
    const loops = new BusyLoops(busy);
    try {
      const results = { ...(await connectEach(stack, issuer, count)), ...(await connectFirsts(starts)) };
      print(results);
      if (json) printJson({ bench: 'connect', count, starts, busy, ...results });
    } finally {
      await stack.stop();
      loops.stop();
    }
  },
};

/** Connects `count` operators in each profile, one after the other. */
async function connectEach(stack: LocalStack, issuer: TestIssuer, count: number) {
  // The robot makes one offer at a time, and the next one when that operator has left.
  const offered = (connected: number) => offers(stack, ROBOT, connected);
  const clients = clientsOf(stack);
  const at = (robot: string, options: { credentials?: Credentials } = {}) =>
    SignaledOperator.connect(stack.signalingUrl, robot, { helloAtOnce: true, ...options });
  const farpointMs = await times(count, () => at(ROBOT));
  const credentials = shownGrant(GRANTED, await grantTo(issuer, Date.now() / 1000));
  const grantedMs = await times(count, () => at(GRANTED, { credentials }));
  const referenceMs = await times(count, () => ReferenceOperator.connect(clients, NAME), offered);
  return { farpointMs, grantedMs, referenceMs };
}

/** Starts everything anew `starts` times, and connects the first operator of a robot in each profile. */
async function connectFirsts(starts: number) {
  const firstMs: number[] = [];
  const firstReferenceMs: number[] = [];
  for (let n = 0; n < starts; n++) {
    const fresh = await LocalStack.start({
      robots: [
        { id: ROBOT, name: NAME, args: ARGS },
        { id: GRANTED, name: OTHER_NAME, reference: true, args: ARGS },
      ],
      env: ENV,
    });
    try {
      await offers(fresh, GRANTED, 0);
      firstMs.push(
        await timed(() => SignaledOperator.connect(fresh.signalingUrl, ROBOT, { helloAtOnce: true })),
      );
      firstReferenceMs.push(await timed(() => ReferenceOperator.connect(clientsOf(fresh), OTHER_NAME)));
    } finally {
      await fresh.stop();
    }
  }
  return {
    firstMs: rounded(distribution(firstMs), 0),
    firstReferenceMs: rounded(distribution(firstReferenceMs), 0),
  };
}

type Results = Awaited<ReturnType<typeof connectEach>> & Awaited<ReturnType<typeof connectFirsts>>;

function print(results: Results): void {
  printTable(
    ['connected after, ms', 'p50', 'p95', 'p99', 'max'],
    [
      ['Farpoint’s profile', ...distributionCells(results.farpointMs)],
      ['with a grant', ...distributionCells(results.grantedMs)],
      ['reference profile', ...distributionCells(results.referenceMs)],
      ['a robot’s first, Farpoint’s profile', ...distributionCells(results.firstMs)],
      ['a robot’s first, reference profile', ...distributionCells(results.firstReferenceMs)],
    ],
  );
}

interface Connected {
  close(): Promise<unknown>;
}

const clientsOf = (stack: LocalStack) => `ws://127.0.0.1:${stack.ports.referenceClient}`;

/** Waits until the robot has made more offers in the reference profile than this. */
async function offers(stack: LocalStack, robot: string, connected: number): Promise<void> {
  while ((await metricOf(stack.robotAdminUrl(robot), 'farpoint_robot_reference_offers')) <= connected)
    await new Promise((resolve) => setTimeout(resolve, 20));
}

/** How long it takes until the operator is connected, ms. */
async function timed(connect: () => Promise<Connected>): Promise<number> {
  const began = performance.now();
  const operator = await connect();
  const ms = performance.now() - began;
  await operator.close();
  return ms;
}

async function times(
  count: number,
  connect: () => Promise<Connected>,
  ready: (connected: number) => Promise<unknown> = async () => undefined,
) {
  const ms: number[] = [];
  for (let n = 0; n < count; n++) {
    await ready(n);
    ms.push(await timed(connect));
  }
  return rounded(distribution(ms), 0);
}
