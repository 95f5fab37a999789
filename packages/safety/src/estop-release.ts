import type { EstopCause, EstopReleasePolicy } from '@farpoint/protocol';
import type { EstopLatch } from './estop.ts';

/** Why the emergency stop was not released. */
export type EstopReleaseRefusal =
  | 'not-lease-holder' // whoever asks neither drives nor supervises
  | 'not-latched'
  | 'held-at-robot' // a stop at the robot itself holds it, and is released there only
  | 'newer-latch' // the request means an older latch: it was on its way when somebody latched it again
  | 'not-supervisor' // only supervisors release what an operator has latched
  | 'not-latcher' // an operator who is there has latched it, and this one has not
  | 'others-latched'; // this operator's own latch is withdrawn, but others have latched it too

export type EstopReleaseOutcome = { released: true } | { released: false; reason: EstopReleaseRefusal };

export interface EstopRelease {
  /** `null`: somebody at the robot. */
  operatorId: string | null;
  holdsLease: boolean;
  supervises: boolean;
  /** Number of the latch that is meant; left out, it is the present one. */
  of?: number | undefined;
}

/**
 * Releases the emergency stop if the request may. Nobody, not even a supervisor, releases what a stop at the robot holds.
 * What the robot itself latched for another reason is released by whoever drives. With the
 * policy `latcher`, a latch by operators who have left, or from before the robot's restart, is too. An operator whose
 * subject is known (latchers.ts) may release its latch in another session, and until it has left keeps others from it.
 */
export function releaseEstop(
  estop: EstopLatch,
  policy: EstopReleasePolicy,
  { operatorId, holdsLease, supervises, of }: EstopRelease,
): EstopReleaseOutcome {
  if (!supervises && !holdsLease) return refused('not-lease-holder');
  if (!estop.latched) return refused('not-latched');
  if (estop.holders.size > 0) return refused('held-at-robot');
  if (of !== undefined && of !== estop.number) return refused('newer-latch');
  const rule = releaseRule(estop, policy);
  if (!supervises && rule === 'supervisor') return refused('not-supervisor');
  if (!supervises && rule === 'latcher') {
    if (operatorId === null || !estop.latchers.has(operatorId)) return refused('not-latcher');
    estop.latchers.withdraw(operatorId);
    if (estop.latchers.present > 0) return refused('others-latched');
  }
  estop.release();
  return { released: true };
}

/** Who may release the present latch, besides supervisors, once no stop at the robot holds it. */
function releaseRule(estop: EstopLatch, policy: EstopReleasePolicy): EstopReleasePolicy {
  if (policy === 'supervisor' && estop.ofOperator) return 'supervisor';
  return policy === 'latcher' && estop.latchers.present > 0 ? 'latcher' : 'driver';
}

/** What an operator must know of the emergency stop in order to release it; `null` while it is not latched. */
export function causeOf(
  estop: EstopLatch,
  policy: EstopReleasePolicy,
  operatorId: string,
): Omit<EstopCause, 'pressedBy' | 'start'> | null {
  const { latched, number: latch, holders, latchers } = estop;
  if (!latched) return null;
  const held = holders.size === 0 ? {} : { heldBy: [...holders] };
  const yours = latchers.has(operatorId);
  return { type: 'estopCause', latch, yours, ...held, release: releaseRule(estop, policy) };
}

function refused(reason: EstopReleaseRefusal): EstopReleaseOutcome {
  return { released: false, reason };
}
