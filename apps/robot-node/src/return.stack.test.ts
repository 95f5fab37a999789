/** A robot that has lost its operators, at the real robot program: it comes back along its track, under guard. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { EmulatedLink, LocalStack } from '@farpoint/local-stack';
import type { ReturnState } from '@farpoint/protocol';
import { isAvailable, StopBlockWriter } from '@farpoint/shared-memory';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ID = 'sim-1';
const SMALL = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];
const RETURNS = ['--return', '--return-after-s', '5', '--return-announce-s', '1', '--lease-silence-s', '1'];
/** How far the robot is driven, m: there is furniture farther ahead. */
const WAY_M = 0.7;

let folder: string;
let stack: LocalStack;
let link: EmulatedLink | null = null;
const operators: SignaledOperator[] = [];

beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'farpoint-return-'));
});
afterEach(async () => {
  for (const operator of operators.splice(0)) await operator.close().catch(() => undefined);
  await link?.stop();
  link = null;
  await stack.stop();
  rmSync(folder, { recursive: true, force: true });
});

async function start(...args: string[]): Promise<void> {
  const all = [...SMALL, ...RETURNS, ...args];
  stack = await LocalStack.start({ robots: [{ id: ID, name: 'Robot', args: all }] });
}

async function connect(url = stack.signalingUrl): Promise<SignaledOperator> {
  const operator = await SignaledOperator.connect(url, ID);
  operators.push(operator);
  return operator;
}

const metric = (name: string) => metricOf(stack.robotAdminUrl(ID), `farpoint_robot_${name}`);
const until = async (is: () => Promise<boolean>) => {
  while (!(await is())) await new Promise((resolve) => setTimeout(resolve, 10));
};
const ended = (end: string) => until(async () => (await metric(`return_ended_total{reason="${end}"}`)) === 1);
const back = (metres: number) => until(async () => (await metric('return_metres_total')) >= metres);

type Client = SignaledOperator['client'];
const xOf = ({ telemetry }: Client) => telemetry?.pose.position.x ?? Number.NaN;
const told = ({ telemetry }: Client): ReturnState | undefined => telemetry?.motion?.return;

/**
 * Drives the robot forwards, with a hand that let go first.
 *
 * @param lost a lease that the operator has no longer
 * @returns where it began, and the lease
 */
async function drive(client: Client, metres = WAY_M, lost = ''): Promise<{ from: number; lease: string }> {
  await client.until(() => client.telemetry !== null);
  const from = xOf(client);
  client.sendSession({ type: 'leaseRequest', take: false });
  const { lease = '' } = await client.message(
    'lease',
    (each) => each.holder === 'you' && each.lease !== lost,
  );
  client.drive(lease, 0);
  const timer = setInterval(() => client.drive(lease, 0.4), 20);
  await client.until(() => Math.abs(xOf(client) - from) > metres);
  clearInterval(timer);
  client.drive(lease, 0);
  await client.until(() => client.telemetry?.twist.linear.x === 0);
  return { from, lease };
}

/** Resolves after the robot has sent its state so often again. */
async function states(client: Client, count: number): Promise<void> {
  const { sequence } = client.telemetry ?? { sequence: 0 };
  await client.until(() => (client.telemetry?.sequence ?? 0) >= sequence + count);
}

describe('a robot that has lost its operators', { timeout: 90_000 }, () => {
  it('comes back to where it was first driven, and says so to who comes then', async () => {
    const auditLog = join(folder, 'audit.jsonl');
    await start('--return-unseen', 'slow', '--audit-log', auditLog);
    const driver = await connect();
    const { from } = await drive(driver.client);
    await driver.vanish();
    await ended('track-end');
    expect(await metric('return_begun_total')).toBe(1);
    const { client } = await connect();
    await client.until(() => told(client) !== undefined);
    expect(told(client)).toMatchObject({ phase: 'ended', end: 'track-end' });
    expect(told(client)?.metres).toBeGreaterThan(WAY_M - 0.15);
    expect(Math.abs(xOf(client) - from)).toBeLessThan(0.15);
    // Whoever drives next is told of it no longer.
    await drive(client, 0.1);
    await client.until(() => told(client) === undefined);
    await stack.robot(ID).stop();
    const kinds = readFileSync(auditLog, 'utf8').match(/"kind":"return-[a-z]+"/g);
    expect(kinds).toEqual(['"kind":"return-began"', '"kind":"return-ended"']);
  });

  it.each(['gives the lease back', 'closes its connection and ends its session'])(
    'stays where it is if its driver %s',
    async (how) => {
      await start('--return-unseen', 'slow');
      const driver = await connect();
      await drive(driver.client);
      if (how === 'gives the lease back') {
        const { client } = driver;
        client.sendSession({ type: 'leaseRelease' });
        const newest = () => client.session.findLast((each) => each.type === 'lease');
        await client.until(() => newest()?.holder === 'nobody');
        await driver.vanish();
      } else {
        // As a page does: the end of the connection may reach the robot first.
        await driver.client.close();
        await until(async () => (await metric('sessions_ended_total{reason="connection-lost"}')) === 1);
        driver.leave();
      }
      // One that is lost waits from the first second on.
      for (const endMs = performance.now() + 4000; performance.now() < endMs; ) {
        const health = await (await fetch(`${stack.robotAdminUrl(ID)}/healthz`)).text();
        expect(health).toContain('"phase":"standby"');
        await new Promise((resolve) => setTimeout(resolve, 20));
      }
      expect(await metric('return_begun_total')).toBe(0);
    },
  );

  it('stands as soon as its link is back, and waits for a fresh hand', async () => {
    await start('--return-unseen', 'slow');
    link = await EmulatedLink.start(stack, { args: ['--rate-mbps', '20', '--rtt-ms', '10'] });
    const { client } = await connect(link.signalingUrl);
    const { from, lease } = await drive(client);
    const far = xOf(client);
    const blackhole = (active: boolean) => link?.tell({ type: 'blackhole', direction: 'both', active });
    blackhole(true);
    // The way that is left is long enough for a link that takes a while to be heard again.
    await back(0.2);
    blackhole(false);
    // The hand has held on meanwhile; a page sends nothing while its path is lost.
    const holding = setInterval(() => client.drive(lease, 0.4), 20);
    await ended('service-back');
    await client.until(() => told(client)?.phase === 'ended');
    expect(told(client)?.end).toBe('service-back');
    await client.until(() => client.telemetry?.twist.linear.x === 0);
    const stood = xOf(client);
    expect(stood).toBeGreaterThan(from + 0.1);
    // As far as it had come back when its link returned, but for the rounding of what it tells.
    expect(stood).toBeLessThan(far - 0.19);
    await states(client, 20);
    expect(xOf(client)).toBe(stood);
    clearInterval(holding);
    expect((await drive(client, 0.1, lease)).from).toBe(stood);
  });

  it.skipIf(!isAvailable())('stands when it is stopped at the robot, and for good', async () => {
    let pressed = false;
    const writer = new StopBlockWriter(join(folder, 'stop'));
    const beating = setInterval(() => writer.write(pressed), 20);
    try {
      await start('--return-unseen', 'slow', '--stop-shm', 'stop', '--shm-folder', folder);
      const driver = await connect();
      await drive(driver.client);
      await driver.vanish();
      await back(0.2);
      pressed = true;
      await ended('estop');
      pressed = false;
      const { client } = await connect();
      await client.until(() => told(client) !== undefined);
      expect(told(client)).toMatchObject({ phase: 'ended', end: 'estop' });
      const stood = xOf(client);
      await states(client, 20);
      expect(xOf(client)).toBe(stood);
    } finally {
      clearInterval(beating);
      writer.close();
    }
  });

  it('stays where no sensor sees the way back, unless it is told otherwise', async () => {
    await start('--return-blocked-s', '1', '--sim-floor', 'unseen');
    const driver = await connect();
    await drive(driver.client);
    const far = xOf(driver.client);
    await driver.vanish();
    await ended('unseen');
    const { client } = await connect();
    await client.until(() => told(client) !== undefined);
    expect(xOf(client)).toBe(far);
    expect(await metric('return_metres_total')).toBe(0);
  });
});
