/** The real robot program with a camera and wheels in shared memory: processes, signaling, WebRTC. */

import { LocalStack } from '@farpoint/local-stack';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { CloudProducer, isAvailable, ReferenceControlReader } from '@farpoint/shared-memory';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { driveUntil } from './testing/steady-hand.ts';

const ROBOT = 'shm-1';
const POINTS = 1500;

describe.skipIf(!isAvailable())('robot process in shared memory (needs the addon: pnpm build:native)', () => {
  const folder = useFolder();
  let stack: LocalStack;
  let producing: NodeJS.Timeout;
  let producer: CloudProducer;
  let operator: SignaledOperator;
  let wheels: ReferenceControlReader;

  beforeAll(async () => {
    producer = new CloudProducer({ folder, format: 'points', maxPoints: POINTS });
    const points = Float32Array.from({ length: POINTS * 4 }, (_, i) => (i % 4 === 2 ? 2 : 0.5));
    const header = { capturedAtMs: null, width: 50, height: 30, pose: null, lens: null, latencyTest: false };
    producing = setInterval(() => producer.publish({ points }, header), 20);
    const args = ['--source', 'shm', '--shm-folder', folder, '--sink', 'shm'];
    stack = await LocalStack.start({ robots: [{ id: ROBOT, name: 'Robot', args }] });
    operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    wheels = new ReferenceControlReader(folder);
  }, 60_000);

  afterAll(async () => {
    clearInterval(producing);
    wheels?.close();
    producer?.close();
    await operator?.close();
    await stack?.stop();
  }, 30_000);

  const speed = () => wheels.read()?.twist.linear.x ?? null;
  it('streams the camera’s clouds', { timeout: 30_000 }, async () => {
    const { client } = operator;
    await client.until(() => client.completeFrames.some((frame) => frame.points === POINTS));
    expect(client.malformedPackets).toBe(0);
  });

  it('writes the operator’s commands, zero on silence, and zero when it ends', {
    timeout: 30_000,
  }, async () => {
    const lease = await operator.client.takeLease();
    expect(speed()).toBe(0);
    await driveUntil(operator.client, lease, 0.25, () => speed() === 0.25);
    await eventually(() => speed() === 0);
    // The robot is alive: the counter advances, and the next command is obeyed.
    const counter = wheels.read()?.counter ?? 0;
    await eventually(() => (wheels.read()?.counter ?? 0) > counter + 2);
    await driveUntil(operator.client, lease, 0.25, () => speed() === 0.25);
    await stack.robot(ROBOT).stop();
    expect(speed()).toBe(0);
  });

  it('refuses motion when the program that reads the velocities has answered and stops', {
    timeout: 30_000,
  }, async () => {
    await operator.close();
    await stack.restartRobot(ROBOT);
    operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    const { client } = operator;
    const lease = await client.takeLease();
    const base = new ReferenceControlReader(folder, { answers: true });
    const answering = setInterval(() => {
      const block = base.read();
      if (block !== null) base.answer(block.counter);
    }, 20);
    const healthy = async () => (await fetch(`${stack.robotAdminUrl(ROBOT)}/healthz`)).ok;
    client.drive(lease, 0);
    await driveUntil(operator.client, lease, 0.25, () => speed() === 0.25);
    expect(await healthy()).toBe(true);
    const driving = setInterval(() => client.drive(lease, 0.25), 20);
    await eventually(() => speed() === 0.25);
    // Whatever moves the wheels is killed.
    clearInterval(answering);
    await client.message('rejected', ({ reason }) => reason === 'no-wheels');
    await eventually(() => speed() === 0);
    expect(await healthy()).toBe(false);
    await client.until(() => client.readings.get('shared_control')?.level === 'error');
    clearInterval(driving);
    base.close();
    await stack.robot(ROBOT).stop();
  });

  it('writes zero and ends in order when its terminal hangs up', { timeout: 30_000 }, async () => {
    await operator.close();
    await stack.restartRobot(ROBOT);
    operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    const lease = await operator.client.takeLease();
    operator.client.drive(lease, 0);
    await driveUntil(operator.client, lease, 0.25, () => speed() === 0.25);
    const robot = stack.robot(ROBOT);
    robot.signal('SIGHUP');
    expect(await robot.exited).toMatchObject({ code: 0 });
    expect(speed()).toBe(0);
  });
});
