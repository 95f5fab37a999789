/** A robot that only operators of the reference system drive, after it was killed: somebody at the robot releases it. */
import { spawnSync } from 'node:child_process';
import { ReferenceOperator } from '@farpoint/conformance';
import { LocalStack, repositoryRoot } from '@farpoint/local-stack';
import { zeroTwist } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import { testFolder } from '@farpoint/service/testing/folder';
import { isAvailable, ReferenceControlReader } from '@farpoint/shared-memory';
import { describe, expect, it, onTestFinished } from 'vitest';

const ID = 'sim-1';
const SMALL = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];

describe.skipIf(!isAvailable())('a robot of reference operators (needs the addon: pnpm build:native)', () => {
  it('drives after a kill once somebody at the robot has released it, for a hand that has let go', {
    timeout: 60_000,
  }, async () => {
    const folder = testFolder();
    const state = ['--state-dir', folder];
    const args = [...SMALL, ...state, '--sink', 'shm', '--shm-folder', folder];
    const stack = await LocalStack.start({ robots: [{ id: ID, name: ID, args, reference: true }] });
    onTestFinished(() => stack.stop(), 30_000);
    await stack.robot(ID).kill();
    await stack.restartRobot(ID);
    const clientUrl = `ws://127.0.0.1:${stack.ports.referenceClient}/`;
    const operator = await ReferenceOperator.connect(clientUrl, ID);
    onTestFinished(() => operator.close(), 30_000);
    operator.say('start');
    await operator.packets.next();
    const wheels = new ReferenceControlReader(folder);
    onTestFinished(() => wheels.close());
    const speed = () => wheels.read()?.twist.linear.x ?? 0;
    let wish = 0;
    let fastest = 0;
    const driving = setInterval(() => {
      const twist = zeroTwist();
      twist.linear.x = wish;
      operator.command(twist);
      fastest = Math.max(fastest, speed());
    }, 20);
    onTestFinished(() => clearInterval(driving));
    const drivesFor = async (packets: number) => {
      let count = 0;
      await operator.packets.next(() => ++count > packets);
    };
    await drivesFor(100);
    // A stick that is held from now on, latched, through the release and after it.
    wish = 0.3;
    await drivesFor(200);
    expect(fastest).toBe(0);
    const command = ['apps/robot-node/src/main.ts', 'release', '--id', ID, ...state];
    const { status, stdout } = spawnSync(process.execPath, command, {
      cwd: repositoryRoot,
      encoding: 'utf8',
    });
    expect([status, stdout]).toEqual([0, expect.stringContaining('Released')]);
    await drivesFor(200);
    expect(fastest).toBe(0);
    // After a gap in the commands, as a busy machine makes them, the robot waits for the hand to let go once more.
    const grips = async () => {
      wish = 0;
      await drivesFor(50);
      wish = 0.3;
      await drivesFor(50);
      return speed() > 0.2;
    };
    await eventually(grips);
  });
});
