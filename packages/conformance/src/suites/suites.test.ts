/** The suites against our own programs, as anybody would run them: over the network, knowing nothing of their insides. */
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

/** Signaling and a robot; signaling and a bridge, without any robot but the suite's. */
let stack: LocalStack;
let alone: LocalStack;
let bridge: BridgeProcess;
beforeAll(async () => {
  stack = await LocalStack.start({ robots: [ROBOT] });
  alone = await LocalStack.start({ robots: [] });
  bridge = await BridgeProcess.start(alone);
}, 60_000);
afterAll(async () => {
  await bridge.stop();
  await alone.stop();
  await stack.stop();
}, 30_000);

describe('signaling', () => {
  it.each(signalingSuite.map(({ name, run }) => [name, run] as const))('%s', async (_name, run) => {
    const { referenceRobot, referenceClient } = stack.ports;
    await run({ robot: `ws://127.0.0.1:${referenceRobot}`, client: `ws://127.0.0.1:${referenceClient}` });
  });
});

describe('robot', { timeout: 30_000 }, () => {
  it.each(robotSuite.map(({ name, run }) => [name, run] as const))('%s', async (_name, run) => {
    await run({ client: `ws://127.0.0.1:${stack.ports.referenceClient}`, name: ROBOT.name });
  });
});

describe('bridge', { timeout: 30_000 }, () => {
  it.each(bridgeSuite.map(({ name, run }) => [name, run] as const))('%s', async (_name, run) => {
    const { control, telemetry, streaming } = bridge.ports;
    const at = (port: number) => `ws://127.0.0.1:${port}`;
    await run({
      robot: at(alone.ports.referenceRobot),
      control: at(control),
      telemetry: at(telemetry),
      streaming: at(streaming),
    });
  });
});

it('the suites find what is wrong', async () => {
  const wrong = { robot: 'ws://127.0.0.1:1', client: 'ws://127.0.0.1:1' };
  for (const { run } of signalingSuite) await expect(run(wrong)).rejects.toThrow('step 1');
});
