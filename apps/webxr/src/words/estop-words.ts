/** What the page says about the emergency stop: who pressed it and why it is on, and who may release it. */
import type { EstopCause, EstopState, LeaseState, Role } from '@farpoint/protocol';
import { texts } from './language.ts';

export interface EstopFacts {
  /** By the robot's latest message. */
  estop: EstopState;
  /** `null` if the robot does not say more. */
  cause: EstopCause | null;
  holder: LeaseState['holder'];
  /** The driver's name, by its grant. */
  driver: string | null;
  /** What this operator's grant allows; `null` if the robot asks for none. */
  role: Role | null;
  /** Whether something has come from the robot just now. */
  heard: boolean;
}

/** The emergency stop while it is latched. */
export interface LatchedStop {
  /** Who or what stopped the robot, and why. */
  why: string;
  /** How it is released: by this operator, or by whom else. */
  release: string;
  /** Whether this operator may release it. */
  mayRelease: boolean;
  /** Whether the robot says so now: otherwise it said so before it fell silent. */
  heard: boolean;
}

/** `null` while it is not latched. */
export function latchedStop(facts: EstopFacts): LatchedStop | null {
  if (!facts.estop.latched) return null;
  const { heard } = facts;
  const { hold, unheard } = texts().stop;
  const others = heard ? whoElse(facts) : unheard;
  return { why: whyWords(facts), release: others ?? hold, mayRelease: others === null, heard };
}

function whyWords({ estop: { by, releasedAt }, cause }: EstopFacts): string {
  const said = texts().stop;
  if (cause?.heldBy !== undefined)
    return said.heldBy([...new Set(cause.heldBy.map((holder) => said.holders[holder]))]);
  if (releasedAt === 'robot') return said.heldAtRobot;
  if (cause?.start !== undefined && cause.pressedBy === undefined) return said.starts[cause.start];
  if (cause?.yours === true) return said.byYou;
  if (cause?.pressedBy !== undefined) return said.by(cause.pressedBy);
  return by === 'robot' ? said.byRobot : said.byOperator;
}

/** Who releases it if this operator may not; `null` if it may. */
function whoElse({ estop, cause, holder, driver, role }: EstopFacts): string | null {
  const said = texts().stop;
  if (estop.releasedAt === 'robot') return said.releasedThere;
  if (role === 'supervise') return null;
  if (cause?.release === 'supervisor') return said.supervisorReleases;
  if (role === 'watch') return said.youWatch;
  if (cause?.release === 'latcher' && !cause.yours)
    return said.presserReleases(cause.pressedBy ?? said.whoeverPressed);
  if (holder === 'other') return said.driverReleases(driver ?? said.whoeverDrives);
  return null;
}
