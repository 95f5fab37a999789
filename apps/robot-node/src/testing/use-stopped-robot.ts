/** A robot with stops of its own, and an operator of it. */

import { LocalStack, type RobotSpec } from '@farpoint/local-stack';
import type { EstopState, Reading } from '@farpoint/protocol';
import { testFolder } from '@farpoint/service/testing/folder';
import { afterEach, beforeEach } from 'vitest';
import { SignaledOperator } from './signaled-operator.ts';

export const ID = 'sim-1';
const SMALL = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];

export const HELD = { latched: true, releasedAt: 'robot' } as const;
export const CLEAR = { latched: false } as const;

export type Client = SignaledOperator['client'];

/** What a test of such a robot has; all of it ends with the test. */
export interface StoppedRobot {
  /** Empty at first. */
  readonly folder: string;
  /** Called after the test. */
  readonly ending: (() => unknown)[];
  start(
    args: string[],
    more?: Partial<RobotSpec>,
    env?: Record<string, string>,
  ): Promise<{ stack: LocalStack; driver: SignaledOperator }>;
  connect(stack: LocalStack): Promise<SignaledOperator>;
}

/** Call it at the top of the file. */
export function useStoppedRobot(): StoppedRobot {
  let folder = '';
  let stack: LocalStack | null = null;
  let operator: SignaledOperator | null = null;
  const ending: (() => unknown)[] = [];
  beforeEach(() => {
    folder = testFolder();
  });
  afterEach(async () => {
    await operator?.close();
    await stack?.stop();
    [operator, stack] = [null, null];
    for (const end of ending.splice(0)) await end();
  });
  const connect = async ({ signalingUrl }: LocalStack) => {
    operator = await SignaledOperator.connect(signalingUrl, ID);
    return operator;
  };
  return {
    get folder() {
      return folder;
    },
    ending,
    connect,
    async start(args, more = {}, env = {}) {
      const robot = { id: ID, name: 'Robot', args: [...SMALL, ...args], ...more };
      stack = await LocalStack.start({ robots: [robot], env });
      return { stack, driver: await connect(stack) };
    },
  };
}

const newest = ({ session }: Client) =>
  session.findLast((message): message is EstopState => message.type === 'estop');

export async function untilState(client: Client, expected: Partial<EstopState>): Promise<void> {
  const is = (state: EstopState | undefined) =>
    state !== undefined &&
    Object.entries(expected).every(([key, value]) => state[key as keyof EstopState] === value);
  await client.until(() => is(newest(client)));
}

/** What stops it is only what an operator may release. */
export async function untilOperatorsOwn(client: Client): Promise<void> {
  await client.until(() => {
    const state = newest(client);
    return state?.latched === true && state.releasedAt === undefined;
  });
}

export async function untilReading(client: Client, stop: string, level: Reading['level']): Promise<void> {
  await client.until(() => client.readings.get(`stop:${stop}`)?.level === level);
}

/**
 * Drives with a hand that let go first, until the robot moves; drives on until the returned function is called. Until it moves, the
 * hand also lets go after each stop: a busy machine may keep the counter waiting that holds a stop open.
 */
export async function driving(client: Client, lease: string): Promise<() => void> {
  let [wasHeld, hasMoved] = [true, false];
  const timer = setInterval(() => {
    const isHeld = newest(client)?.latched === true;
    const opens = !hasMoved && (isHeld || wasHeld);
    wasHeld = isHeld;
    client.drive(lease, opens ? 0 : 0.1);
  }, 20);
  await client.until(() => (client.telemetry?.twist.linear.x ?? 0) > 0.05);
  hasMoved = true;
  return () => clearInterval(timer);
}
