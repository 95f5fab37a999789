import { type LinkProfile, Random } from '@farpoint/network-sim';
import type { Driving, Fault } from '@farpoint/robot-node/testing/faults';
import type { ScenarioOperator } from '../operator.ts';
import { Scenario } from '../scenario.ts';
import { drivingIn } from './scenario-rig.ts';

/** A quarter of full speed. */
const SHARE = 0.25;
export const SPEED = 0.25;
/** How long a robot is watched after the cause, and after its end, ms. */
const WATCHED_MS = 1200;
/** How long a robot takes at most until it drives as fast as before, ms. */
const DRIVES_AGAIN_MS = 2000;
/** How long a cause lasts that goes away, ms: longer than a gap after which the robot would move on. */
const LASTS_MS = 1600;

export interface FaultOutcome {
  /** From the cause to the first lower velocity that the wheels were told, ms; `null` if there was none. */
  brakedAfterMs: number | null;
  /** From the cause to the first zero. */
  stoodAfterMs: number | null;
  /** From the cause until the end of what the newest command before the braking was valid for. */
  validAfterMs: number;
  /** The highest speed after the robot had stood, m/s. */
  movedAgain: number;
  /** Speed at the end, m/s. */
  endSpeed: number;
  /** The highest speed that the wheels were ever told, m/s. */
  fastest: number;
  log: string;
}

/** A link that loses packets, and whose delay jumps. The first is clean: 20 Mbit/s, 5 ms. */
export function linkOf(seed: number): Partial<LinkProfile> {
  if (seed === 1) return {};
  const random = new Random(seed, 7);
  return {
    delayMs: 5 + Math.floor(random.next() * 70),
    jitterMs: random.next() * 5,
    jitterReorders: random.chance(0.5),
    loss: random.next() * 0.03,
    reorder: { probability: random.next() * 0.05, extraMs: 15 },
    duplicate: random.next() * 0.02,
  };
}

/** The longest time that a packet takes on it, ms. */
export function longestWayMs(seed: number): number {
  const { delayMs = 5, jitterMs = 0, reorder } = linkOf(seed);
  // And a millisecond in the bottleneck, one to the next of the clock.
  return delayMs + jitterMs + (reorder?.extraMs ?? 0) + 2;
}

interface Caused {
  scenario: Scenario;
  driver: ScenarioOperator;
  driving: Driving;
  /** When the cause was done. */
  causeMs: number;
}

/** Lets a robot be driven on a link of this seed, and the fault's cause happen. @param then what is seen of it */
async function afterCause<Outcome>(
  fault: Fault,
  seed: number,
  then: (caused: Caused) => Outcome | Promise<Outcome>,
): Promise<Outcome> {
  using scenario = new Scenario({
    seed,
    link: linkOf(seed),
    args: ['--take-policy', 'always'],
  });
  const driver = scenario.driving(SHARE);
  const driving = drivingIn(scenario, driver);
  const causeMs = await scenario.happens(() => fault.cause(driving));
  scenario.log.add('cause');
  return await then({ scenario, driver, driving, causeMs });
}

/** Lets a robot be driven, and the fault happen. */
export async function runFault(fault: Fault, seed: number): Promise<FaultOutcome> {
  return await afterCause(fault, seed, ({ scenario, causeMs }) => {
    const { wheels } = scenario.robot;
    scenario.run(WATCHED_MS);
    const [braked, stoodMs] = [wheels.braked(causeMs), wheels.stoodMs(causeMs)];
    return {
      brakedAfterMs: braked === null ? null : braked.atMs - causeMs,
      stoodAfterMs: stoodMs === null ? null : stoodMs - causeMs,
      validAfterMs: (braked?.validUntilMs ?? 0) - causeMs,
      movedAgain: stoodMs === null ? 0 : wheels.fastestSince(stoodMs),
      endSpeed: wheels.speed,
      fastest: wheels.fastest,
      log: scenario.log.text,
    };
  });
}

/** Whether a robot that stood while something was wrong moved when that ended, and drove again after the hand had let go. */
export interface ReturnOutcome {
  stood: boolean;
  movedWhileWrong: number;
  movedBeforeLetGo: number;
  drivesAgain: boolean;
  log: string;
}

/** Lets the fault happen, and end again, with the hand held on; then the hand lets go, and grips again. */
export async function runReturn(
  fault: Fault & { ends(driving: Driving): void | Promise<void> },
  seed: number,
): Promise<ReturnOutcome> {
  return await afterCause(fault, seed, async ({ scenario, driver, driving, causeMs }) => {
    const { wheels } = scenario.robot;
    scenario.run(LASTS_MS);
    const stoodMs = wheels.stoodMs(causeMs);
    const movedWhileWrong = stoodMs === null ? SPEED : wheels.fastestSince(stoodMs);
    const endMs = await scenario.happens(() => fault.ends(driving));
    scenario.run(WATCHED_MS);
    const movedBeforeLetGo = wheels.fastestSince(endMs);
    driver.hand.letGo();
    scenario.run(700);
    driver.hand.push(SHARE);
    scenario.run(DRIVES_AGAIN_MS);
    return {
      ...{ stood: stoodMs !== null, movedWhileWrong, movedBeforeLetGo },
      drivesAgain: Math.abs(wheels.speed - SPEED) < 1e-6,
      log: scenario.log.text,
    };
  });
}
