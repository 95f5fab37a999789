/** What the page says once of a STOP that another operator presses or releases; the band says what is on. */
import type { LeaseState, Operators } from '@farpoint/operator';
import type { EstopCause, EstopState } from '@farpoint/protocol';
import { listedNameWords, nameWords } from './handover-words.ts';
import { texts } from './language.ts';

/** `null` if it was this operator, or none. */
export function pressedNotice(
  { by }: Pick<EstopState, 'by'>,
  cause: EstopCause | null,
  operators: Operators | null,
): string | null {
  if (by !== 'operator' || cause === null || cause.yours) return null;
  const said = texts().stop;
  return said.hasPressed(presserWords(cause, operators) ?? said.anotherOperator);
}

/** Who pressed STOP, as the page names people; `null` if the robot does not say. */
export function presserWords(cause: EstopCause | null, operators: Operators | null): string | null {
  if (cause?.yours === true) return texts().people.presser.you;
  return cause?.pressedBy === undefined ? null : listedNameWords(cause.pressedBy, operators);
}

interface WhoIsHere {
  readonly operators: Operators | null;
  readonly holder: LeaseState['holder'];
}

/**
 * The robot does not say who has released it. Where only one operator may, that one has. `null` if nobody else is here.
 *
 * @param last what the robot said of it while it was latched
 */
export function releasedNotice(
  last: Pick<EstopState, 'releasedAt'>,
  cause: EstopCause | null,
  here: WhoIsHere,
): string | null {
  const said = texts().stop;
  if (last.releasedAt === 'robot') return said.releasedAtRobot;
  if (othersIn(here).length === 0) return null;
  return said.hasReleased(releaserWords(cause, here) ?? said.anotherOperator);
}

/** The only other operator who could release it, as the page names people; `null` if there are several, or none. */
export function releaserWords(cause: EstopCause | null, here: WhoIsHere): string | null {
  const able = othersIn(here).filter(
    ({ role, drives, away }) =>
      away !== true &&
      (role === 'supervise' ||
        (role === 'drive' && cause?.release !== 'supervisor' && (drives || here.holder === 'nobody'))),
  );
  const [one] = able;
  const isSure = one !== undefined && able.length === 1 && here.operators?.more === undefined;
  return isSure ? nameWords(one) : null;
}

function othersIn({ operators }: WhoIsHere): Operators['operators'] {
  return operators?.operators.filter(({ you }) => !you) ?? [];
}
