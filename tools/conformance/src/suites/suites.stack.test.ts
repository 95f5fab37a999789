/**
 * The suites against our own programs, as anybody would run them: over the network, without knowing their internals.
 */
import { BridgeProcess, LocalStack } from '@farpoint/local-stack';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { bridgeSuite } from './bridge-suite.ts';
import { robotSuite } from './robot-suite.ts';
import { signalingSuite } from './signaling-suite.ts';

const ROBOT = {
  id: 'sim-1',
  name: 'Simulated robot',
  reference: true,
  args: ['--sim-size', '64', '--max-points', '700'],
};

/** Signaling and a robot; signaling and a bridge, without any robot but the suite's; signaling alone. */
let stack: LocalStack;
let alone: LocalStack;
let fresh: LocalStack;
let bridge: BridgeProcess;
beforeAll(async () => {
  stack = await LocalStack.start({ robots: [ROBOT] });
  alone = await LocalStack.start({ robots: [] });
  fresh = await LocalStack.start({ robots: [] });
  bridge = await BridgeProcess.start(alone);
}, 60_000);
afterAll(async () => {
  await bridge.stop();
  await alone.stop();
  await fresh.stop();
  await stack.stop();
}, 30_000);

const at = (port: number) => `ws://127.0.0.1:${port}`;

describe('signaling', () => {
  // The service without robots, so that the suite gets its first id.
  it.each(signalingSuite.map(({ name, run }) => [name, run] as const))('%s', async (_name, run) => {
    const { referenceRobot, referenceClient } = fresh.ports;
    const target = { robot: at(referenceRobot), client: at(referenceClient) };
    await expect(run(target, 'strict')).resolves.toBeUndefined();
  });
});

describe('robot', { timeout: 60_000 }, () => {
  it.each(robotSuite.map(({ name, run }) => [name, run] as const))('%s', async (_name, run) => {
    const target = { client: at(stack.ports.referenceClient), name: ROBOT.name };
    await expect(run(target, 'strict')).resolves.toBeUndefined();
  });
});

describe('bridge', { timeout: 60_000 }, () => {
  it.each(bridgeSuite.map(({ name, run }) => [name, run] as const))('%s', async (_name, run) => {
    const { control, telemetry, streaming } = bridge.ports;
    const target = {
      robot: at(alone.ports.referenceRobot),
      client: at(alone.ports.referenceClient),
      control: at(control),
      telemetry: at(telemetry),
      streaming: at(streaming),
    };
    await expect(run(target, 'strict')).resolves.toBeUndefined();
  });
});

it('the suites detect faults', async () => {
  const wrong = { robot: at(1), client: at(1) };
  for (const { run } of signalingSuite) await expect(run(wrong, 'strict')).rejects.toThrow('step 1');
});
