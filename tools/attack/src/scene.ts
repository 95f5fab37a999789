import { createSocket, type Socket } from 'node:dgram';
import { once } from 'node:events';
import { mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { isIPv6 } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { makeIssuer, type TestIssuer } from '@farpoint/grants/testing';
import { BridgeProcess, LocalStack, type ManagedProcess } from '@farpoint/local-stack';
import { SignaledOperator, type SignaledOperatorOptions } from '@farpoint/robot-node/testing';
import { metricOf } from '@farpoint/robot-node/testing/metric-of';
import { Bystanders } from './bystanders.ts';
import { HarmError, inTime, mustHold } from './harm.ts';
import { LiveDriver } from './live-driver.ts';

export const ROBOT = 'sim-1';
export const GRANTED_ROBOT = 'sim-2';
const SMALL = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];
/** Memory that a program may gain by one attack, bytes: several times what garbage collection leaves. */
const MAX_GROWTH_BYTES = 128 << 20;
/** The same for all attacks together. */
const MAX_TOTAL_GROWTH_BYTES = 384 << 20;

/** The real programs, and people who use them while they are attacked. */
export class Scene {
  readonly stack: LocalStack;
  readonly bridge: BridgeProcess;
  readonly issuer: TestIssuer;
  readonly folder: string;
  driver: LiveDriver;
  readonly #bystanders: Bystanders;
  readonly #processes: ReadonlyMap<string, { process: ManagedProcess; firstBytes: number; bytes: number }>;
  #stranger: Socket;
  readonly #cleanups: (() => unknown)[] = [];

  private constructor(parts: {
    stack: LocalStack;
    bridge: BridgeProcess;
    issuer: TestIssuer;
    folder: string;
    driver: LiveDriver;
    bystanders: Bystanders;
    stranger: Socket;
  }) {
    const { stack, bridge } = parts;
    this.stack = stack;
    this.bridge = bridge;
    this.issuer = parts.issuer;
    this.folder = parts.folder;
    process.once('exit', this.#forget);
    this.driver = parts.driver;
    this.#bystanders = parts.bystanders;
    this.#stranger = parts.stranger;
    const processes = [stack.robot(ROBOT), stack.robot(GRANTED_ROBOT), stack.signaling, bridge.process];
    this.#processes = new Map(
      processes.map((process) => {
        const bytes = residentBytes(process.pid);
        return [process.name, { process, firstBytes: bytes, bytes }];
      }),
    );
  }

  /** Lets the signaling service pass on a list of revoked grants, whoever signed it. */
  revoke(list: string): void {
    const draft = join(this.folder, 'revoked.new');
    writeFileSync(draft, list);
    renameSync(draft, join(this.folder, 'revoked.jws'));
  }

  static async start(): Promise<Scene> {
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-attack-'));
    const issuer = await makeIssuer('k1');
    const keys = join(folder, 'grant-keys.json');
    writeFileSync(keys, JSON.stringify({ keys: [issuer.publicJwk] }));
    const stack = await LocalStack.start({
      robots: [
        { id: ROBOT, name: 'Driven robot', args: [...SMALL, '--sim-commands', '--max-operators', '4'] },
        { id: GRANTED_ROBOT, name: 'Robot with grants', args: [...SMALL, '--grant-keys', keys] },
      ],
      signalingArgs: ['--revocations', join(folder, 'revoked.jws')],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    });
    try {
      const bridge = await BridgeProcess.start(stack, { env: { FARPOINT_LOG_LEVEL: 'warn' } });
      const driver = await LiveDriver.start(stack.signalingUrl, ROBOT);
      const bystanders = await Bystanders.start(stack);
      const [host] = driver.robotAddress;
      const stranger = createSocket(isIPv6(host) ? 'udp6' : 'udp4').bind(0);
      await once(stranger, 'listening');
      return new Scene({ stack, bridge, issuer, folder, driver, bystanders, stranger });
    } catch (error) {
      await stack.stop();
      throw error;
    }
  }

  /** Closes it after the attack. */
  later(cleanup: () => unknown): void {
    this.#cleanups.push(cleanup);
  }

  /** Sends to the robot's socket of the driver's session from an address that the robot does not know. */
  async fromStranger(...datagrams: readonly Uint8Array[]): Promise<void> {
    const [host, port] = this.driver.robotAddress;
    for (const datagram of datagrams) {
      await new Promise((resolve) => this.#stranger.send(datagram, port, host, resolve));
    }
  }

  /** Sends as somebody would who forges the driver's address. */
  async asDriver(...datagrams: readonly Buffer[]): Promise<void> {
    for (const datagram of datagrams) await this.driver.connection.send(datagram);
  }

  async fromBoth(...datagrams: readonly Buffer[]): Promise<void> {
    await this.fromStranger(...datagrams);
    await this.asDriver(...datagrams);
  }

  /** @throws {HarmError} if the robot has sent anything to the stranger within `ms` of what `act` did */
  async unanswered(act: () => Promise<void>, ms = 200): Promise<void> {
    let answers = 0;
    const count = () => answers++;
    this.#stranger.on('message', count);
    await act();
    await new Promise((resolve) => setTimeout(resolve, ms));
    this.#stranger.off('message', count);
    mustHold(answers === 0, `the robot sent ${answers} datagrams to a stranger`);
  }

  /** Another operator with a session of its own, which may misbehave. */
  async guest(options: SignaledOperatorOptions = {}): Promise<SignaledOperator> {
    for (let tries = 0; ; tries++) {
      const guest = await this.asker(ROBOT, options);
      await guest.until(({ type }) => type === 'session.offer' || type === 'session.closed');
      if (guest.heard.some(({ type }) => type === 'session.offer')) {
        await inTime(guest.client.ready(), 'an operator gets no session');
        return guest;
      }
      if (tries > 200) throw new HarmError('the robot has no place for another operator');
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }

  /** An operator that asks for a session, whatever comes of it. */
  async asker(robot: string, options: SignaledOperatorOptions = {}): Promise<SignaledOperator> {
    const asker = await SignaledOperator.open(this.stack.signalingUrl, robot, options);
    this.later(() => asker.close());
    return asker;
  }

  async metric(name: string, labels = '', robot = ROBOT): Promise<number> {
    return metricOf(this.stack.robotAdminUrl(robot), `${name}${labels}`);
  }

  /** Closes what the last attack has opened, and judges what came of it. @returns `null` if everything held */
  async harm(): Promise<string | null> {
    for (const cleanup of this.#cleanups.splice(0).reverse()) {
      await inTime(Promise.resolve(cleanup()), '', 2000).catch(() => undefined);
    }
    try {
      for (const [name, { process }] of this.#processes) mustHold(process.running, `${name} has ended`);
      await this.driver.expectDriving();
      await this.#bystanders.expectIntroductions();
      const health = await inTime(fetch(`${this.bridge.adminUrl}/healthz`), 'the bridge does not answer');
      mustHold(health.ok, 'the bridge is not well');
      for (const [name, facts] of this.#processes) {
        const bytes = residentBytes(facts.process.pid);
        const grown = Math.max(
          bytes - facts.bytes - MAX_GROWTH_BYTES,
          bytes - facts.firstBytes - MAX_TOTAL_GROWTH_BYTES,
        );
        mustHold(grown < 0, `${name} has grown from ${megabytes(facts.bytes)} to ${megabytes(bytes)} MB`);
        facts.bytes = bytes;
      }
      return null;
    } catch (error) {
      return error instanceof Error ? error.message : String(error);
    }
  }

  /** Resident memory of the robot, bytes. */
  get robotBytes(): number {
    return residentBytes(this.stack.robot(ROBOT).pid);
  }

  async stop(): Promise<void> {
    for (const cleanup of this.#cleanups.splice(0)) await Promise.resolve(cleanup()).catch(() => undefined);
    await this.driver.close().catch(() => undefined);
    this.#stranger.close();
    this.#bystanders.close();
    await this.bridge.stop();
    await this.stack.stop();
    process.off('exit', this.#forget);
    this.#forget();
  }

  readonly #forget = (): void => rmSync(this.folder, { recursive: true, force: true });
}

function megabytes(bytes: number): number {
  return Math.round(bytes / 2 ** 20);
}

function residentBytes(pid: number): number {
  try {
    const kilobytes = /^VmRSS:\s+(\d+)/m.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))?.[1];
    return Number(kilobytes ?? 0) * 1024;
  } catch {
    // Not Linux, or it has ended, which is judged elsewhere.
    return 0;
  }
}
