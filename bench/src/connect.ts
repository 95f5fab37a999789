/** `pnpm bench connect`: how long it takes to establish a session. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { ReferenceOperator } from '@farpoint/conformance';
import { makeProof, soleFingerprint } from '@farpoint/grants';
import { grantTo, makeIssuer } from '@farpoint/grants/testing';
import { LocalStack } from '@farpoint/local-stack';
import { SignaledOperator } from '@farpoint/robot-node/testing';
import { type Bench, distributionCells, numberOption, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench connect [--count 20] [--json]

Real signaling and robot (simulated office), each in its own process, without a network between them. An operator in this
process connects --count times in each profile, one after the other. It starts the DTLS handshake as soon as its own
connectivity checks succeed, which may be before the robot's do. Farpoint profile: from opening the signaling socket to the
robot's welcome; with a grant: at a robot that asks for one, with the proof that goes with it. Reference profile: from the client port of signaling to the open data channels, once the robot's offer exists.`;

const ROBOT = 'sim-1';
const GRANTED = 'sim-2';
const NAME = 'Simulated robot';

export const bench: Bench = {
  name: 'connect',
  summary: 'time from signaling to a session, in both profiles',
  async run(argv) {
    const { values } = parseArgs({
      args: argv,
      options: {
        count: { type: 'string', default: '20' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
    });
    if (values.help) return console.log(USAGE);
    const count = numberOption('count', values.count, 1);
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-bench-connect-'));
    const keys = join(folder, 'grant-keys.json');
    const issuer = await makeIssuer();
    writeFileSync(keys, JSON.stringify({ keys: [issuer.publicJwk] }));
    const args = ['--sim-size', '64'];
    const stack = await LocalStack.start({
      robots: [
        { id: ROBOT, name: NAME, reference: true, args },
        { id: GRANTED, name: NAME, args: [...args, '--grant-keys', keys] },
      ],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    });
    try {
      // The robot makes one offer at a time, and the next one when that operator has left.
      const offered = async (connected: number) => {
        while ((await metric(stack, 'reference_offers')) <= connected) {
          await new Promise((resolve) => setTimeout(resolve, 20));
        }
      };
      const clients = `ws://127.0.0.1:${stack.ports.referenceClient}`;
      const farpointMs = await times(count, async () => {
        const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT, { helloAtOnce: true });
        return () => operator.close();
      });
      const { grant, key } = await grantTo(issuer, Date.now() / 1000);
      const grantedMs = await times(count, async () => {
        const operator = await SignaledOperator.connect(stack.signalingUrl, GRANTED, {
          helloAtOnce: true,
          credentials: async ({ session, offer, answer }) => {
            const operatorFingerprint = soleFingerprint(answer) ?? '';
            const robotFingerprint = soleFingerprint(offer) ?? '';
            const facts = { robot: GRANTED, session, operatorFingerprint, robotFingerprint };
            return { grant, proof: await makeProof(grant, facts, key, Date.now() / 1000) };
          },
        });
        return () => operator.close();
      });
      const referenceMs = await times(
        count,
        async () => {
          const operator = await ReferenceOperator.connect(clients, NAME);
          return () => operator.close();
        },
        offered,
      );
      const results = { farpointMs, grantedMs, referenceMs };
      printTable(
        ['connected after, ms', 'p50', 'p95', 'p99', 'max'],
        [
          ['Farpoint’s profile', ...distributionCells(farpointMs)],
          ['with a grant', ...distributionCells(grantedMs)],
          ['reference profile', ...distributionCells(referenceMs)],
        ],
      );
      if (values.json) printJson({ bench: 'connect', count, ...results });
    } finally {
      await stack.stop();
      rmSync(folder, { recursive: true });
    }
  },
};

async function metric(stack: LocalStack, name: string): Promise<number> {
  const text = await (await fetch(`${stack.robotAdminUrl(ROBOT)}/metrics`)).text();
  const line = text.split('\n').find((row) => row.startsWith(`farpoint_robot_${name} `));
  return Number(line?.split(' ').at(-1) ?? 0);
}

/** @param connect returns a function that closes the connection again */
async function times(
  count: number,
  connect: () => Promise<() => Promise<unknown>>,
  ready: (connected: number) => Promise<unknown> = async () => undefined,
) {
  const ms: number[] = [];
  for (let n = 0; n < count; n++) {
    await ready(n);
    const began = performance.now();
    const close = await connect();
    ms.push(performance.now() - began);
    await close();
  }
  return rounded(distribution(ms), 0);
}
