/** The robot program where one of its two signaling services does not exist. */
import { once } from 'node:events';
import { type AddressInfo, createServer, type Server } from 'node:net';
import { ReferenceOperator } from '@farpoint/conformance';
import { ReleasedSignaling } from '@farpoint/conformance/testing';
import { freePorts, LocalStack, ManagedProcess, repositoryRoot } from '@farpoint/local-stack';
import { testFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it, onTestFinished } from 'vitest';
import { SignaledOperator } from '../../testing/signaled-operator.ts';

const ROBOT = 'sim-1';
const NAME = 'Simulated robot';
const ARGS = ['--sim-size', '64', '--max-points', '650'];
/** Enough for a robot that warned at each of them to be seen. */
const ATTEMPTS = 4;

/** A port whose connections end at once, as where nothing is, but which can count them. */
class AbsentService {
  attempts = 0;
  readonly #server: Server;

  private constructor(server: Server) {
    this.#server = server;
    server.on('connection', (socket) => {
      this.attempts++;
      socket.on('error', () => undefined).resetAndDestroy();
    });
  }

  static async open(): Promise<AbsentService> {
    const server = createServer().listen(0, '127.0.0.1');
    await once(server, 'listening');
    onTestFinished(() => void server.close());
    return new AbsentService(server);
  }

  get url(): string {
    return `ws://127.0.0.1:${(this.#server.address() as AddressInfo).port}`;
  }

  async untilAttempts(count: number): Promise<void> {
    while (this.attempts < count) await once(this.#server, 'connection');
  }
}

/** Starts a robot. @returns a function that ends it, and gives its warnings about signaling */
async function startRobot(signaling: string, reference: string): Promise<() => Promise<string[]>> {
  const [adminPort] = await freePorts(1);
  const folder = testFolder();
  const lines: string[] = [];
  const robot = await ManagedProcess.start({
    name: 'robot',
    command: [
      ...['node', 'apps/robot-node/src/main.ts', '--id', ROBOT, '--name', NAME],
      ...['--signaling', signaling, '--reference-signaling', reference],
      ...['--admin-port', String(adminPort), '--state-dir', folder, ...ARGS],
    ],
    cwd: repositoryRoot,
    readyUrl: `http://127.0.0.1:${adminPort}/healthz`,
    onLine: (_, line) => lines.push(line),
  });
  onTestFinished(async () => void (await robot.stop()));
  return async () => {
    await robot.stop();
    return lines
      .map((line) => JSON.parse(line) as { level: string; msg: string })
      .filter(({ level, msg }) => ['warn', 'error', 'fatal'].includes(level) && msg.includes('signaling'))
      .map(({ msg }) => msg);
  };
}

describe('a robot without one of its signaling services', { timeout: 90_000 }, () => {
  it('says once that its own is not there, however often it tries, and serves reference operators', async () => {
    const absent = await AbsentService.open();
    const released = await ReleasedSignaling.start();
    onTestFinished(() => released.stop());
    const end = await startRobot(absent.url, released.robotUrl);
    const operator = await ReferenceOperator.connect(released.clientUrl, NAME);
    onTestFinished(() => operator.close());
    operator.say('start');
    await operator.packets.next();
    await absent.untilAttempts(ATTEMPTS);
    expect(await end()).toEqual(['no connection to signaling; will keep trying silently']);
  });

  it('says once that the reference signaling is not there, and serves its own operators', async () => {
    const absent = await AbsentService.open();
    const stack = await LocalStack.start({ robots: [] });
    onTestFinished(() => stack.stop());
    const end = await startRobot(stack.signalingUrl, absent.url);
    const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    onTestFinished(() => operator.close());
    await operator.client.until(() => operator.client.packets > 0);
    await absent.untilAttempts(ATTEMPTS);
    expect(await end()).toEqual(['no connection to the reference signaling; trying again']);
  });
});
