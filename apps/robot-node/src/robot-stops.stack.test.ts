/** Stops at the robot itself, at the real robot program: shared memory, a stand-in for a GPIO chip, the console, DDS. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { DdsGraph, isAvailable as isDdsAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import { FAKE_CHIP, FakeChip } from '@farpoint/gpio/testing';
import { LocalStack, type RobotSpec } from '@farpoint/local-stack';
import type { EstopState, Reading } from '@farpoint/protocol';
import { messageBytes } from '@farpoint/ros/testing';
import { isAvailable, StopBlockWriter } from '@farpoint/shared-memory';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { monotonicMs } from './clock.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ID = 'sim-1';
const SMALL = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];

let folder: string;
let stack: LocalStack | null = null;
let operator: SignaledOperator | null = null;
const ending: (() => unknown)[] = [];

beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'farpoint-stops-'));
});
afterEach(async () => {
  await operator?.close();
  await stack?.stop();
  [operator, stack] = [null, null];
  for (const end of ending.splice(0)) await end();
  rmSync(folder, { recursive: true, force: true });
});

async function start(args: string[], more: Partial<RobotSpec> = {}, env: Record<string, string> = {}) {
  const robot = { id: ID, name: 'Robot', args: [...SMALL, ...args], ...more };
  stack = await LocalStack.start({ robots: [robot], env });
  return { stack, driver: await connect(stack) };
}

async function connect({ signalingUrl }: LocalStack): Promise<SignaledOperator> {
  operator = await SignaledOperator.connect(signalingUrl, ID);
  return operator;
}

type Client = SignaledOperator['client'];

async function untilState(client: Client, expected: Partial<EstopState>): Promise<void> {
  const newest = () => client.session.findLast((message): message is EstopState => message.type === 'estop');
  const is = (state: EstopState | undefined) =>
    state !== undefined &&
    Object.entries(expected).every(([key, value]) => state[key as keyof EstopState] === value);
  await client.until(() => is(newest()));
}

const HELD = { latched: true, releasedAt: 'robot' } as const;
const CLEAR = { latched: false } as const;

async function untilReading(client: Client, stop: string, level: Reading['level']): Promise<void> {
  await client.until(() => client.readings.get(`stop:${stop}`)?.level === level);
}

/** Drives with a hand that let go first, until the robot moves; drives on until the returned function is called. */
async function driving(client: Client, lease: string): Promise<() => void> {
  client.drive(lease, 0);
  const timer = setInterval(() => client.drive(lease, 0.1), 20);
  await client.until(() => (client.telemetry?.twist.linear.x ?? 0) > 0.05);
  return () => clearInterval(timer);
}

const until = async (is: () => boolean | Promise<boolean>) => {
  while (!(await is())) await new Promise((resolve) => setTimeout(resolve, 5));
};

describe('a stop byte in shared memory', { skip: !isAvailable(), timeout: 40_000 }, () => {
  it('stops a driving robot, whoever asks for release; a counter that stands still does, too', async () => {
    let pressed = false;
    let beats = true;
    const writer = new StopBlockWriter(join(folder, 'stop'));
    const beating = setInterval(() => beats && writer.write(pressed), 20);
    ending.push(
      () => clearInterval(beating),
      () => writer.close(),
    );
    const { stack, driver } = await start(['--stop-shm', 'stop', '--shm-folder', folder]);
    const { client } = driver;
    await untilState(client, CLEAR);
    const lease = await client.takeLease();
    let end = await driving(client, lease);
    pressed = true;
    await untilState(client, { ...HELD, by: 'robot' });
    await client.until(() => client.telemetry?.twist.linear.x === 0);
    client.releaseEstop();
    expect(await client.message('fault')).toMatchObject({ message: expect.stringContaining('at the robot') });
    await untilState(client, HELD);
    await untilReading(client, 'shm', 'warn');
    // The hand that holds on moves nothing after the release.
    pressed = false;
    await untilState(client, CLEAR);
    const { sequence } = client.telemetry ?? { sequence: 0 };
    await client.until(() => (client.telemetry?.sequence ?? 0) > sequence + 4);
    expect(client.telemetry?.twist.linear.x).toBe(0);
    end();
    end = await driving(client, lease);
    beats = false;
    await untilState(client, HELD);
    end();
    await untilReading(client, 'shm', 'error');
    const health = async () => (await fetch(`${stack.robotAdminUrl(ID)}/healthz`)).json();
    await until(async () => JSON.stringify(await health()).includes('"shm":"silent"'));
    const metrics = await (await fetch(`${stack.robotAdminUrl(ID)}/metrics`)).text();
    // More of them where a busy machine kept the counter waiting.
    const [, stops] = /robot_stops[^\n]*stop="shm"[^\n]* (\d+)\n/.exec(metrics) ?? [];
    expect(Number(stops)).toBeGreaterThanOrEqual(2);
    beats = true;
    await untilState(client, CLEAR);
    // A program that has ended, and one that makes the file anew.
    rmSync(join(folder, 'stop'));
    await untilState(client, HELD);
    beats = false;
    const next = new StopBlockWriter(join(folder, 'stop'));
    const others = setInterval(() => next.write(false), 20);
    ending.push(
      () => clearInterval(others),
      () => next.close(),
    );
    await untilState(client, CLEAR);
  });
});

const chip = FakeChip.build();
describe('a GPIO line (stand-in for a chip)', { skip: chip === null, timeout: 40_000 }, () => {
  it('stops while it is active, and when it cannot be read', async () => {
    if (chip === null) return;
    ending.push(() => chip.close());
    chip.set(17, true);
    const name = FAKE_CHIP.replace('/dev/', '');
    const { driver } = await start(['--stop-gpio', `${name}:17:active-low`], {}, chip.env);
    const { client } = driver;
    await untilState(client, CLEAR);
    const lease = await client.takeLease();
    const end = await driving(client, lease);
    chip.set(17, false);
    await untilState(client, HELD);
    await client.until(() => client.telemetry?.twist.linear.x === 0);
    end();
    chip.set(17, true);
    await untilState(client, CLEAR);
    chip.unplug(17);
    await untilState(client, HELD);
    await untilReading(client, 'gpio', 'error');
    chip.set(17, true);
    await untilState(client, CLEAR);
    // An operator's own latch stays, and is released as ever.
    client.sendSession({ type: 'estop', latch: true, press: 1 });
    await untilState(client, { latched: true, by: 'operator' });
    chip.set(17, false);
    await untilState(client, { ...HELD, by: 'operator' });
    chip.set(17, true);
    await client.until(() => {
      const state = client.session.findLast((message): message is EstopState => message.type === 'estop');
      return state?.latched === true && state.releasedAt === undefined;
    });
    client.releaseEstop();
    await untilState(client, CLEAR);
  });
});

describe('the console', { timeout: 40_000 }, () => {
  it('stops by any key, over a restart, until somebody types release; without a console the robot stands', async () => {
    const { stack, driver } = await start(['--stop-key'], { input: true });
    const { client } = driver;
    await untilState(client, CLEAR);
    stack.robot(ID).type(' ');
    await untilState(client, HELD);
    await driver.close();
    await stack.robot(ID).kill();
    await stack.restartRobot(ID);
    const after = await connect(stack);
    await untilState(after.client, HELD);
    await after.client.takeLease();
    after.client.releaseEstop();
    await after.client.message('fault');
    stack.robot(ID).type('release\n');
    // It was killed: what is left is the latch of an unclean exit, which whoever drives releases.
    await after.client.until(() => {
      const state = after.client.session.findLast(
        (message): message is EstopState => message.type === 'estop',
      );
      return state?.latched === true && state.releasedAt === undefined;
    });
    after.client.releaseEstop();
    await untilState(after.client, CLEAR);
    stack.robot(ID).type(null);
    await untilReading(after.client, 'key', 'error');
    await untilState(after.client, HELD);
  });
});

describe('a topic in a ROS 2 graph', { skip: !isDdsAvailable(), timeout: 60_000 }, () => {
  it('stops when it is true, silent, or gone', async () => {
    const graph = new DdsGraph({ domain: testDomain(), localhostOnly: true, now: monotonicMs });
    ending.push(() => graph.close());
    const type = 'std_msgs/msg/Bool';
    let publisher = graph.advertise({ topic: '/stop', type });
    let says: boolean | null = false;
    const publishing = setInterval(() => {
      if (says !== null) publisher.publish(messageBytes(2, type, { data: says }));
    }, 50);
    ending.push(() => clearInterval(publishing));
    const config = join(folder, 'farpoint.yaml');
    writeFileSync(
      config,
      `robot:
  sink: { kind: ros2 }
  ros: { domain: ${testDomain()}, reach: localhost }
  topics: [{ topic: /cmd_vel, as: velocity }]
  stops: { topic: /stop }
`,
    );
    const wheels = graph.subscribe(
      { topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', queue: 4 },
      () => undefined,
    );
    ending.push(() => wheels.close());
    const { driver } = await start(['--config', config]);
    const { client } = driver;
    await untilState(client, CLEAR);
    says = true;
    await untilState(client, HELD);
    says = false;
    await untilState(client, CLEAR);
    says = null;
    await untilState(client, HELD);
    await untilReading(client, 'topic', 'error');
    says = false;
    await untilState(client, CLEAR);
    publisher.close();
    says = null;
    await untilState(client, HELD);
    publisher = graph.advertise({ topic: '/stop', type });
    says = false;
    await untilState(client, CLEAR);
  });
});
