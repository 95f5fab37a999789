/** What the page says once of a STOP that another operator presses or releases; the band says what is on. */
import type { LeaseState, Operators } from '@farpoint/operator';
import type { EstopCause, EstopState } from '@farpoint/protocol';
import { listedNameWords, nameWords } from './handover-words.ts';

/** `null` if it was this operator, or none. */
export function pressedNotice(
  { by }: Pick<EstopState, 'by'>,
  cause: EstopCause | null,
  operators: Operators | null,
): string | null {
  if (by !== 'operator' || cause === null || cause.yours) return null;
  return `${presserWords(cause, operators) ?? 'Another operator'} has pressed STOP.`;
}

/** Who pressed STOP, as the page names people; `null` if the robot does not say. */
export function presserWords(cause: EstopCause | null, operators: Operators | null): string | null {
  if (cause?.yours === true) return 'you';
  return cause?.pressedBy === undefined ? null : listedNameWords(cause.pressedBy, operators);
}

/**
 * The robot does not say who has released it. Where only one operator may, that one has. `null` if nobody else is here.
 *
 * @param last what the robot said of it while it was latched
 */
export function releasedNotice(
  last: Pick<EstopState, 'releasedAt'>,
  cause: EstopCause | null,
  { operators, holder }: { operators: Operators | null; holder: LeaseState['holder'] },
): string | null {
  if (last.releasedAt === 'robot') return 'The emergency stop has been released at the robot.';
  const others = operators?.operators.filter(({ you }) => !you) ?? [];
  if (others.length === 0) return null;
  const able = others.filter(
    ({ role, drives, away }) =>
      away !== true &&
      (role === 'supervise' ||
        (role === 'drive' && cause?.release !== 'supervisor' && (drives || holder === 'nobody'))),
  );
  const [one] = able;
  const isSure = one !== undefined && able.length === 1 && operators?.more === undefined;
  return `${isSure ? nameWords(one) : 'Another operator'} has released the emergency stop.`;
}
