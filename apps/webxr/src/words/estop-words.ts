/** What the page says about the emergency stop: who pressed it and why it is on, and who may release it. */
import type { EstopCause, EstopState, LeaseState, Role } from '@farpoint/protocol';

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

export const LATCHED_TITLE = 'Emergency stop';
/** Under the STOP button. */
export const stopButtonWords = { latched: 'engaged', clear: 'emergency' } as const;

const UNHEARD = 'So the robot said before it fell silent. It can be released when the robot is heard again.';
const HOLD = 'Hold the release control for one second; then let go of the grip and drive.';

const holderWords: Record<NonNullable<EstopCause['heldBy']>[number], string> = {
  topic: 'a program on it',
  shm: 'a program on it',
  gpio: 'its own stop button',
  key: 'a key at its own keyboard',
};
const startWords: Record<NonNullable<EstopCause['start']>, string> = {
  'was-latched': 'The stop was on when the robot was last shut down.',
  'unclean-exit': 'The robot’s program did not shut down in order: it crashed, or lost its power.',
  unreadable: 'The robot cannot read whether a stop was on when it last ran.',
  unwritable: 'The robot cannot store its emergency stop, so it starts stopped.',
};

/** `null` while it is not latched. */
export function latchedStop(facts: EstopFacts): LatchedStop | null {
  if (!facts.estop.latched) return null;
  const { heard } = facts;
  const others = heard ? whoElse(facts) : UNHEARD;
  return { why: whyWords(facts), release: others ?? HOLD, mayRelease: others === null, heard };
}

function whyWords({ estop: { by, releasedAt }, cause }: EstopFacts): string {
  if (cause?.heldBy !== undefined) {
    const held = [...new Set(cause.heldBy.map((holder) => holderWords[holder]))];
    return `The robot is stopped by ${held.join(' and ')}.`;
  }
  if (releasedAt === 'robot') return 'The robot is stopped by a stop on the robot itself.';
  if (cause?.start !== undefined && cause.pressedBy === undefined) return startWords[cause.start];
  if (cause?.yours === true) return 'You pressed STOP.';
  if (cause?.pressedBy !== undefined) return `${cause.pressedBy} pressed STOP.`;
  return by === 'robot' ? 'The robot has stopped itself.' : 'An operator pressed STOP.';
}

/** Who releases it if this operator may not; `null` if it may. */
function whoElse({ estop, cause, holder, driver, role }: EstopFacts): string | null {
  if (estop.releasedAt === 'robot') return 'It is released there, at the robot, and nowhere else.';
  if (role === 'supervise') return null;
  if (cause?.release === 'supervisor') return 'Only a supervisor releases it.';
  if (role === 'watch') return 'Your grant lets you watch: whoever drives releases it.';
  if (cause?.release === 'latcher' && !cause.yours)
    return `${cause.pressedBy ?? 'Whoever pressed STOP'}, or a supervisor, releases it.`;
  if (holder === 'other')
    return `${driver ?? 'Whoever drives'} releases it. To do it yourself, take over first.`;
  return null;
}
