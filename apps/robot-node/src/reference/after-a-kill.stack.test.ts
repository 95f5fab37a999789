/** A robot that only operators of the reference system drive, after it was killed: somebody at the robot releases it. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { ReferenceOperator } from '@farpoint/conformance';
import { LocalStack, repositoryRoot } from '@farpoint/local-stack';
import { zeroTwist } from '@farpoint/protocol';
import { isAvailable, ReferenceControlReader } from '@farpoint/shared-memory';
import { afterEach, describe, expect, it, vi } from 'vitest';

const ID = 'sim-1';
const SMALL = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];

const cleanups: (() => unknown)[] = [];
afterEach(async () => {
  for (const cleanup of cleanups.splice(0).reverse()) await cleanup();
}, 30_000);

describe.skipIf(!isAvailable())('a robot of reference operators (needs the addon: pnpm build:native)', () => {
  it('drives after a kill once somebody at the robot has released it, for a hand that has let go', {
    timeout: 60_000,
  }, async () => {
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-after-a-kill-'));
    cleanups.push(() => rmSync(folder, { recursive: true, force: true }));
    const state = ['--state-dir', folder];
    const args = [...SMALL, ...state, '--sink', 'shm', '--shm-folder', folder];
    const stack = await LocalStack.start({ robots: [{ id: ID, name: ID, args, reference: true }] });
    cleanups.push(() => stack.stop());
    await stack.robot(ID).kill();
    await stack.restartRobot(ID);
    const clientUrl = `ws://127.0.0.1:${stack.ports.referenceClient}/`;
    const operator = await ReferenceOperator.connect(clientUrl, ID);
    cleanups.push(() => operator.close());
    operator.say('start');
    await operator.packets.next();
    const wheels = new ReferenceControlReader(folder);
    cleanups.push(() => wheels.close());
    const speed = () => wheels.read()?.twist.linear.x ?? 0;
    let wish = 0;
    let fastest = 0;
    const driving = setInterval(() => {
      const twist = zeroTwist();
      twist.linear.x = wish;
      operator.command(twist);
      fastest = Math.max(fastest, speed());
    }, 20);
    cleanups.push(() => clearInterval(driving));
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
    await vi.waitUntil(grips, { timeout: 30_000, interval: 0 });
  });
});
