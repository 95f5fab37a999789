/**
 * What goes wrong while a robot is driven with the grip held, at the real programs. The table with the limits that ship
 * runs in virtual time (tools/scenario); here runs what virtual time cannot have, signals and threads that hang, and a
 * few rows that show that the real programs are linked as the virtual ones are. `pnpm bench faults` runs all rows here and
 * judges each time.
 */
import { isAvailable } from '@farpoint/shared-memory';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';
import { brakingFaults } from './testing/faults/braking-faults.ts';
import { BRAKES_MS, type Fault } from './testing/faults/fault.ts';
import { SPEED } from './testing/faults/fault-hand.ts';
import { FaultRig, type RealDriving } from './testing/faults/fault-rig.ts';
import { FaultTimes } from './testing/faults/fault-times.ts';
import { hangingFaults } from './testing/faults/hanging-faults.ts';
import { harmlessFaults } from './testing/faults/harmless-faults.ts';
import { canHangThreads } from './testing/faults/hung-thread.ts';
import { type ReturningFault, returningFaults } from './testing/faults/returning-faults.ts';

/** One of each way by which the robot notices. */
const SHORT = new Set([
  'the page falls silent',
  'the connection is closed',
  'STOP on the session channel',
  'rubbish on the control channel',
  'the page draws nothing any more',
  'the network is cut',
  'a network that was away',
]);
const isShort = ({ name }: { name: string }) => SHORT.has(name);
const isWhole = process.env.FARPOINT_LONG_TESTS === '1';
const rowsOf = <Row extends { name: string }>(rows: readonly Row[]) =>
  isWhole ? [...rows] : rows.filter(isShort);

/** The robot brakes because its program ends or hangs: the wheels are told zero, or nothing any more. */
const ending: { name: string; signal: NodeJS.Signals; saysZero: boolean }[] = [
  { name: 'the robot is asked to end', signal: 'SIGTERM', saysZero: true },
  { name: 'the robot is interrupted', signal: 'SIGINT', saysZero: true },
  { name: 'the robot’s terminal hangs up', signal: 'SIGHUP', saysZero: true },
  { name: 'the robot is killed', signal: 'SIGKILL', saysZero: false },
  { name: 'the robot crashes', signal: 'SIGSEGV', saysZero: false },
  { name: 'the robot is stopped by a debugger', signal: 'SIGSTOP', saysZero: false },
];

describe.skipIf(!isAvailable())(
  'faults while driving (needs the addon: pnpm build:native)',
  { timeout: 60_000 },
  () => {
    let rig: FaultRig;
    const times = new FaultTimes();

    beforeAll(async () => {
      rig = await FaultRig.start();
    }, 60_000);
    afterEach(() => rig.reset(), 30_000);
    afterAll(async () => {
      const { fastest } = rig.wheels;
      await rig.close();
      console.log(
        `from the cause to braking, ms (the wheels were told ${fastest} m/s at most):\n${times.text()}`,
      );
      times.save();
    }, 60_000);

    async function drive({ behindLink = false, settled = false } = {}): Promise<RealDriving> {
      const operator = await rig.connect(behindLink);
      const { latched } = await operator.client.message('estop');
      const hand = await rig.hand(operator);
      if (latched) {
        operator.releaseEstop();
        await operator.estop(false);
      }
      await hand.gripAnew();
      await (settled ? rig.untilSettled(hand) : rig.untilDriving(hand));
      return { rig, operator, hand };
    }

    /** Takes down when the robot braked: a bench judges that. */
    function note(name: string, causeMs: number, withinMs: number): void {
      const found = rig.wheels.brakingAfter(causeMs);
      if (found === null) throw new Error('the robot has not braked');
      // What this machine was too busy to look at is not the robot's.
      times.add(name, found.afterMs, withinMs + found.blindMs);
      expect(rig.wheels.fastest).toBeLessThanOrEqual(SPEED);
    }

    /** @returns when it began to go wrong: some causes take long to prepare, and may say when they began */
    async function begin(cause: Fault<RealDriving>['cause'], driving: RealDriving): Promise<number> {
      const causeMs = performance.now();
      const beganMs = await cause(driving);
      if (typeof beganMs === 'number') return beganMs;
      return rig.wheels.brakingAfter(causeMs) === null ? Math.max(causeMs, performance.now() - 1) : causeMs;
    }

    test.each(rowsOf(brakingFaults))(
      '$name: brakes and stays',
      async ({ name, cause, withinMs = BRAKES_MS, ...how }) => {
        const driving = await drive(how);
        const causeMs = await begin(cause, driving);
        await rig.wheels.until(({ linear }) => linear === 0);
        note(name, causeMs, withinMs);
        await rig.wheels.beats(10);
        expect(rig.wheels.speed).toBe(0);
      },
    );

    test.runIf(isWhole).each(harmlessFaults)('$name: drives on', async ({ cause, ...how }) => {
      const driving = await drive(how);
      await cause(driving);
      await rig.wheels.beats(40);
      // What chance makes of a bad link, or of a busy machine, may stop it for a moment.
      await rig.untilDriving(driving.hand);
      expect(rig.wheels.fastest).toBeLessThanOrEqual(SPEED);
    });

    async function returns({
      name,
      cause,
      ends,
      withinMs,
      silent,
      ...how
    }: ReturningFault<RealDriving>): Promise<void> {
      const driving = await drive(how);
      const causeMs = await begin(cause, driving);
      try {
        await rig.wheels.until(({ linear }) => linear === 0);
        if (withinMs !== undefined) note(name, causeMs, withinMs);
        // Longer than a gap after which it would move on, and shorter than what frees the lease.
        const stoodMs = performance.now();
        await (silent ? rig.wheels.silence(600) : rig.wheels.until(({ atMs }) => atMs - stoodMs > 1000));
      } finally {
        await ends(driving);
      }
      await rig.wheels.beats(25);
      expect(rig.wheels.speed).toBe(0);
      await rig.untilDriving(driving.hand);
    }

    test.each(rowsOf(returningFaults))('$name: stays until the hand has let go', returns);

    describe.skipIf(!canHangThreads())('threads that hang (needs python3 and ptrace)', () => {
      test.each(hangingFaults)('$name: stays until the hand has let go', returns);
    });

    test('signaling is killed: the robot still drives', async () => {
      const { hand } = await drive();
      await rig.stack.signaling.kill();
      await rig.untilDriving(hand);
      expect(rig.wheels.speed).toBe(SPEED);
      await rig.stack.startSignaling();
    });

    test.each(ending)(
      '$name: the wheels are told zero, or nothing any more',
      async ({ name, signal, saysZero }) => {
        await drive();
        const causeMs = performance.now();
        rig.robot.signal(signal);
        if (saysZero) {
          await rig.wheels.until(({ linear }) => linear === 0);
          note(name, causeMs, BRAKES_MS);
          await rig.robot.exited;
        } else {
          await rig.wheels.silence(200);
          times.add(`${name}: the last word`, Math.max(0, rig.wheels.lastWrittenMs - causeMs), BRAKES_MS);
          await rig.robot.kill();
        }
        await rig.restartRobot();
        // After an end that was not in order it starts latched.
        const operator = await rig.connect();
        const state = await operator.client.message('estop');
        expect(state.latched).toBe(!saysZero);
      },
    );
  },
);
