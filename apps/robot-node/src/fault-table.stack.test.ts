/**
 * What goes wrong while a robot is driven with the grip held, and how soon it brakes: at the real programs, from the
 * cause to the first lower velocity that the wheels are told. Prints the times, and judges them mildly, for the
 * machine may be busy; `pnpm bench faults` judges each strictly.
 */
import { RESUME_WITHIN_MS } from '@farpoint/safety';
import { isAvailable } from '@farpoint/shared-memory';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';
import { brakingFaults } from './testing/faults/braking-faults.ts';
import { BRAKES_MS, type Driving, type Fault } from './testing/faults/fault.ts';
import { SPEED } from './testing/faults/fault-hand.ts';
import { FaultRig } from './testing/faults/fault-rig.ts';
import { FaultTimes } from './testing/faults/fault-times.ts';
import { harmlessFaults } from './testing/faults/harmless-faults.ts';
import { canHangThreads } from './testing/faults/hung-thread.ts';
import { hangingFaults, type ReturningFault, returningFaults } from './testing/faults/returning-faults.ts';

/** By so much a busy machine may delay a robot, ms. */
const BUSY_MS = 500;

/**
 * So long without a frame, a robot may brake (its stall is 150 ms above its usual interval), and only a busy machine makes
 * it so long, ms.
 */
const LATE_FRAME_MS = 150;

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

    async function drive({ behindLink = false, settled = false } = {}): Promise<Driving> {
      const operator = await rig.connect(behindLink);
      const { latched } = await operator.client.message('estop');
      const hand = await rig.hand(operator);
      if (latched) {
        operator.client.releaseEstop();
        await operator.client.message('estop', (state) => !state.latched);
      }
      await hand.gripAnew();
      await (settled ? rig.untilSettled(hand) : rig.untilDriving(hand));
      return { rig, operator, hand };
    }

    function judge(name: string, causeMs: number, withinMs: number): void {
      const found = rig.wheels.brakingAfter(causeMs);
      expect(found).not.toBe(null);
      const { afterMs, blindMs } = found as NonNullable<typeof found>;
      // What this machine was too busy to look at is not the robot's.
      times.add(name, afterMs, withinMs + blindMs);
      expect(afterMs).toBeLessThanOrEqual(withinMs + BUSY_MS);
      expect(rig.wheels.fastest).toBeLessThanOrEqual(SPEED);
    }

    /** @returns when it began to go wrong: some causes take long to prepare, and may say when they began */
    async function begin(cause: Fault['cause'], driving: Driving): Promise<number> {
      const causeMs = performance.now();
      const beganMs = await cause(driving);
      if (typeof beganMs === 'number') return beganMs;
      return rig.wheels.brakingAfter(causeMs) === null ? Math.max(causeMs, performance.now() - 1) : causeMs;
    }

    test.each(brakingFaults)(
      '$name: brakes and stays',
      async ({ name, cause, withinMs = BRAKES_MS, ...how }) => {
        const driving = await drive(how);
        const causeMs = await begin(cause, driving);
        await rig.wheels.until(({ linear }) => linear === 0);
        judge(name, causeMs, withinMs);
        await rig.wheels.beats(10);
        expect(rig.wheels.speed).toBe(0);
      },
    );

    test.each(harmlessFaults)('$name: goes on', async ({ cause, ...how }) => {
      const driving = await drive(how);
      const causeMs = performance.now();
      await cause(driving);
      await rig.wheels.beats(40);
      // What chance makes of a bad link may stop it for a moment.
      if (how.behindLink) return await rig.untilDriving(driving.hand);
      // Somebody who joins delays a picture, and a robot whose pictures are late may go slower for a moment.
      const stopped = rig.wheels.stopAfter(causeMs);
      // Unless the machine kept the hand, its picture or the robot waiting, which stops a robot as any silence does.
      const wasKept = (stopped?.blindMs ?? 0) >= 50 || (stopped?.silentMs ?? 0) >= 80;
      if (!wasKept && driving.hand.longestWithoutFrame(causeMs) < LATE_FRAME_MS) expect(stopped).toBe(null);
      expect(rig.wheels.fastest).toBeLessThanOrEqual(SPEED);
    });

    async function returns({ name, cause, ends, withinMs, silent, ...how }: ReturningFault): Promise<void> {
      const driving = await drive(how);
      const causeMs = await begin(cause, driving);
      try {
        await rig.wheels.until(({ linear }) => linear === 0);
        if (withinMs !== undefined) judge(name, causeMs, withinMs);
        // Longer than a gap after which it would move on.
        await (silent ? rig.wheels.silence(600) : rig.wheels.beats(40));
      } finally {
        await ends(driving);
      }
      await rig.wheels.beats(25);
      expect(rig.wheels.speed).toBe(0);
      await rig.untilDriving(driving.hand);
    }

    test('a gap of a quarter of a second in the commands: brakes, and moves on by its ramps', async () => {
      const driving = await drive();
      for (let tries = 0; ; tries++) {
        const causeMs = performance.now();
        const gapMs = await driving.hand.pauses(250);
        const { fastest } = rig.wheels;
        expect(rig.wheels.brakingAfter(causeMs)?.afterMs).toBeLessThanOrEqual(gapMs + BUSY_MS);
        expect(fastest).toBeLessThanOrEqual(SPEED);
        // A machine that was too busy made it longer than the robot allows.
        if (gapMs < RESUME_WITHIN_MS - 50) break;
        expect(tries).toBeLessThan(10);
        await rig.untilDriving(driving.hand);
      }
      await rig.wheels.until(({ linear }) => linear === SPEED);
      expect(driving.operator.client.session).not.toContainEqual(
        expect.objectContaining({ type: 'rejected', reason: 'let-go-first' }),
      );
    });

    test.each(returningFaults)('$name: stays until the hand has let go', returns);

    describe.skipIf(!canHangThreads())('threads that hang (needs python3 and ptrace)', () => {
      test.each(hangingFaults)('$name: stays until the hand has let go', returns);
    });

    test('signaling is killed: the robot goes on', async () => {
      await drive();
      const causeMs = performance.now();
      await rig.stack.signaling.kill();
      await rig.wheels.beats(40);
      const stopped = rig.wheels.stopAfter(causeMs);
      if (stopped !== null && stopped.blindMs < 50 && stopped.silentMs < 80) expect(stopped).toBe(null);
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
          judge(name, causeMs, BRAKES_MS);
          await rig.robot.exited;
        } else {
          await rig.wheels.silence(200);
          const afterMs = Math.max(0, rig.wheels.lastWrittenMs - causeMs);
          times.add(`${name}: the last word`, afterMs, BRAKES_MS);
          expect(afterMs).toBeLessThanOrEqual(BRAKES_MS + BUSY_MS);
          await rig.robot.kill();
        }
        await rig.restartRobot();
        // After an end that was not in order it starts latched.
        const operator = await rig.connect();
        const state = await operator.client.message('estop');
        expect(state.latched).toBe(!saysZero);
      },
    );

    test('at most half of the faults take longer than they may', () => {
      const late = times.rows.filter(({ ok }) => !ok);
      expect(late.length, JSON.stringify(late)).toBeLessThanOrEqual(times.rows.length / 2);
    });
  },
);
