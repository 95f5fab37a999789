/** `pnpm conformance` as users run it. */
import { execFile } from 'node:child_process';
import { once } from 'node:events';
import { createServer, type Server } from 'node:http';
import { type AddressInfo, createServer as createTcpServer } from 'node:net';
import { fileURLToPath } from 'node:url';
import { afterEach, describe, expect, it, onTestFinished } from 'vitest';
import { ReferenceOperator } from './peers/reference-operator.ts';
import { SocketPeer } from './peers/socket-peer.ts';
import { findUnreachable } from './reach.ts';
import { signalingSuite } from './suites/signaling-suite.ts';
import { type CaseResult, runSuite, whyUnfinished } from './suites/suite.ts';
import { ReleasedSignaling } from './testing/index.ts';

const PROGRAM = fileURLToPath(new URL('main.ts', import.meta.url));

let signaling: ReleasedSignaling | null = null;
afterEach(async () => {
  await signaling?.stop();
  signaling = null;
});

function run(...args: string[]): Promise<{ code: number; out: string; err: string }> {
  return new Promise((resolve) => {
    execFile(process.execPath, [PROGRAM, ...args], (error, out, err) =>
      resolve({ code: error === null ? 0 : Number(error.code), out, err }),
    );
  });
}

it('at level reference, passes the released signaling and names its defects; at level strict, fails it', async () => {
  signaling = await ReleasedSignaling.start();
  const urls = ({ robotUrl, clientUrl }: ReleasedSignaling) => ['--robot', robotUrl, '--client', clientUrl];
  const lenient = await run('signaling', ...urls(signaling), '--level', 'reference', '--json');
  expect(lenient.code).toBe(0);
  expect(lenient.err).toContain('known defect robot-0-dropped');
  expect(lenient.err).toContain('0 failed, 5 known defects at level reference');
  // Each of its defects shows, and no other case fails.
  const results = JSON.parse(lenient.out) as CaseResult[];
  const known = signalingSuite.flatMap(({ defect }) => (defect === undefined ? [] : [defect]));
  expect(results.flatMap(({ defect }) => (defect === null ? [] : [defect]))).toEqual(known);
  expect(results.at(-1)?.outcome).toBe('not-tried');
  expect(signaling.death).toBeNull();
  await signaling.stop();
  // The first id is assigned once.
  signaling = await ReleasedSignaling.start();
  const strict = await run('signaling', ...urls(signaling), '--json');
  expect(strict.code).toBe(1);
  const failed = (JSON.parse(strict.out) as CaseResult[]).filter(({ outcome }) => outcome === 'failed');
  const faulty = signalingSuite.filter(({ defect }) => defect !== undefined);
  expect(failed.map(({ name }) => name)).toEqual(faulty.map(({ name }) => name));
  expect(signaling.death).not.toBeNull();
}, 60_000);

it.each([
  [['signaling', '--level', 'lenient'], '--level lenient: must be one of reference, strict'],
  [['signaling', '--levle', 'strict'], "Unknown option '--levle'"],
  [
    ['signaling', '--robot', 'localhost:301'],
    '--robot localhost:301: must be an address that begins with ws://',
  ],
])('%j: says which argument is invalid', async (args, message) => {
  const { code, err } = await run(...args);
  expect(code).toBe(2);
  expect(err).toContain(message);
  expect(err).not.toContain('    at ');
});

/** Each suite with the options that name an implementation; the bridge reaches signaling by itself. */
const SUITES = {
  signaling: ['robot', 'client'],
  robot: ['client'],
  bridge: ['robot', 'control', 'telemetry', 'streaming'],
} as const;
type Suite = keyof typeof SUITES;

const at = (url: string, suite: Suite) => SUITES[suite].flatMap((option) => [`--${option}`, url]);

async function listening(server: Server | ReturnType<typeof createTcpServer>): Promise<string> {
  server.listen(0, '127.0.0.1');
  await once(server, 'listening');
  onTestFinished(() => void server.close());
  return `127.0.0.1:${(server.address() as AddressInfo).port}`;
}

const webServer = (status: number) =>
  listening(createServer((_, response) => response.writeHead(status).end()));

describe('an address that cannot be reached', () => {
  it.each<[string, string, () => Promise<string>]>([
    ['refuses', 'nothing listens there; check that the program runs', async () => 'ws://127.0.0.1:1'],
    ['is at no host', 'there is no host of that name; check the name', async () => 'ws://robot.invalid:3001'],
    ['is a web server', 'it answers with HTTP status 404', async () => `ws://${await webServer(404)}`],
    ['is a proxy for nobody', 'it answers with HTTP status 502', async () => `ws://${await webServer(502)}`],
    [
      'speaks another protocol',
      'what listens there is no WebSocket server',
      async () => `ws://${await listening(createTcpServer((socket) => socket.end('SSH-2.0-x\r\n')))}`,
    ],
    ['has no TLS', 'it does not speak TLS', async () => `wss://${await webServer(404)}`],
  ])('%s: one sentence', async (_, why, open) => {
    const url = await open();
    const { message } = (await findUnreachable({ robot: url })) ?? {};
    expect(message).toContain(`${url} (--robot) cannot be reached: ${why}`);
    expect(message).not.toContain('\n');
  });
});

describe.each(Object.keys(SUITES) as Suite[])('%s that cannot be reached', (suite) => {
  it('says so in one sentence, and names no defects', async () => {
    const url = 'ws://127.0.0.1:1';
    const { code, out, err } = await run(suite, ...at(url, suite), '--level', 'reference', '--json');
    expect(code).toBe(3);
    expect(err.trim().split('\n')).toHaveLength(1);
    expect(err).toContain(`${url} (--${SUITES[suite][0]}) cannot be reached: nothing listens there`);
    const outcomes = JSON.parse(out).map(({ outcome, defect }: Record<string, unknown>) => [outcome, defect]);
    expect(new Set(outcomes.map(String))).toEqual(new Set(['not-tried,']));
  });
});

it('says which robots there are if the one it looks for has not registered', async () => {
  signaling = await ReleasedSignaling.start();
  const other = await SocketPeer.open(signaling.robotUrl);
  onTestFinished(() => other.close());
  other.send({ type: 'register', name: 'rover', sdpOffer: 'v=0' });
  await other.message({ type: 'registered' });
  const cases = [
    { name: 'connects', run: async () => void (await ReferenceOperator.connect(clientUrl, 'rovr', 2000)) },
  ];
  const { clientUrl } = signaling;
  expect(whyUnfinished(await runSuite(cases, null, 'strict'))).toMatch(
    /^no robot ‘rovr’ \(--name\) is registered at .*: there are ‘rover’$/,
  );
});
