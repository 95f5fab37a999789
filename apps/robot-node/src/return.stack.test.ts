/**
 * A robot that has lost its operators, at the real robot program: it comes back along its track, under guard. When it does
 * not, and what ends it, is asked in virtual time (tools/scenario).
 */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import type { ReturnState } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import { testFolder } from '@farpoint/service/testing/folder';
import { afterEach, describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ID = 'sim-1';
const SMALL = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];
const RETURNS = ['--return', '--return-after-s', '5', '--return-announce-s', '1', '--lease-silence-s', '1'];
/** How far the robot is driven, m: there is furniture farther ahead. */
const WAY_M = 0.7;

let stack: LocalStack;
const operators: SignaledOperator[] = [];
afterEach(async () => {
  for (const operator of operators.splice(0)) await operator.close().catch(() => undefined);
  await stack.stop();
});

async function start(...args: string[]): Promise<void> {
  const all = [...SMALL, ...RETURNS, ...args];
  stack = await LocalStack.start({ robots: [{ id: ID, name: 'Robot', args: all }] });
}

async function connect(): Promise<SignaledOperator> {
  const operator = await SignaledOperator.connect(stack.signalingUrl, ID);
  operators.push(operator);
  return operator;
}

const metric = (name: string) => metricOf(stack.robotAdminUrl(ID), `farpoint_robot_${name}`);
const ended = (end: string) =>
  eventually(async () => (await metric(`return_ended_total{reason="${end}"}`)) === 1);

type Client = SignaledOperator['client'];
const xOf = ({ telemetry }: Client) => telemetry?.pose.position.x ?? Number.NaN;
const told = ({ telemetry }: Client): ReturnState | undefined => telemetry?.motion?.return;

/**
 * Drives the robot forwards, with a hand that let go first.
 *
 * @returns where it began
 */
async function drive(client: Client, metres = WAY_M): Promise<number> {
  await client.until(() => client.telemetry !== null);
  const from = xOf(client);
  client.sendSession({ type: 'leaseRequest', take: false });
  const { lease = '' } = await client.message('lease', (each) => each.holder === 'you');
  client.drive(lease, 0);
  const timer = setInterval(() => client.drive(lease, 0.4), 20);
  await client.until(() => Math.abs(xOf(client) - from) > metres);
  clearInterval(timer);
  client.drive(lease, 0);
  await client.until(() => client.telemetry?.twist.linear.x === 0);
  return from;
}

describe('a robot that has lost its operators', { timeout: 90_000 }, () => {
  it('comes back to where it was first driven, and says so to who comes then', async () => {
    const folder = testFolder();
    const auditLog = join(folder, 'audit.jsonl');
    await start('--return-unseen', 'slow', '--audit-log', auditLog);
    const driver = await connect();
    const from = await drive(driver.client);
    await driver.vanish();
    await ended('track-end');
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

  it('stays where it is if its driver closes its connection and its session', async () => {
    await start('--return-unseen', 'slow');
    const driver = await connect();
    await drive(driver.client);
    // As a page does that is left: the end of the connection and the service's word reach the robot in any order.
    const closed = driver.client.close();
    driver.leave();
    await closed;
    const health = async () => {
      const told = (await (await fetch(`${stack.robotAdminUrl(ID)}/healthz`)).json()) as {
        uptimeSeconds: number;
        checks: { return: { detail: { phase: string } } };
      };
      return { uptimeSeconds: told.uptimeSeconds, phase: told.checks.return.detail.phase };
    };
    await eventually(async () => (await health()).phase === 'standby' && (await metric('operators')) === 0);
    // One that is lost waits from the first second on.
    const { uptimeSeconds } = await health();
    await eventually(async () => (await health()).uptimeSeconds >= uptimeSeconds + 3);
    expect((await health()).phase).toBe('standby');
    expect(await metric('return_active')).toBe(0);
  });
});
