/** Requests for the drive and offers of it, in words. */
import type { Handover, HandoverEnd, LeaseState, NamedOperator, Operators } from '@farpoint/operator';
import type { Words } from './words.ts';

type Named = Pick<Handover, 'kind' | 'from' | 'to'>;

/** @param claimed nothing proves the name */
export function nameWords({ name, claimed }: Pick<NamedOperator, 'name' | 'claimed'>): string {
  return claimed === true ? `“${name}”` : name;
}

/** A name that the robot tells without its number, marked as in its list of who is here. */
export function listedNameWords(name: string, operators: Operators | null): string {
  return nameWords(operators?.operators.find((each) => each.name === name) ?? { name });
}

/** Who drives, if it is another; `null` if the robot does not say. Leases name only drivers with a grant. */
export function driverWords(
  { driver }: Pick<LeaseState, 'driver'>,
  operators: Operators | null,
): string | null {
  if (driver !== undefined) return listedNameWords(driver, operators);
  const listed = operators?.operators.find(({ drives, you }) => drives && !you);
  return listed === undefined ? null : nameWords(listed);
}

/** What another operator wants, and the two answers. */
export function askedWords({ kind, from }: Named): { text: string; accept: string; refuse: string } {
  const name = nameWords(from);
  return kind === 'ask'
    ? { text: `${name} asks to drive`, accept: 'Give the drive', refuse: 'Refuse' }
    : { text: `${name} offers you the drive`, accept: 'Take the drive', refuse: 'Refuse' };
}

/** What this operator waits for. */
export function waitingWords({ kind, to }: Named): string {
  const name = nameWords(to);
  return kind === 'ask' ? `You have asked ${name} for the drive` : `You have offered ${name} the drive`;
}

export type EndedHandover = Named & { yours: boolean; ended: HandoverEnd };

/**
 * What has become of it, for whoever made it or was to answer it; `null` if that operator knows.
 *
 * @param stoppedBy who pressed STOP, as the page names others; `null` if it does not say
 */
export function handoverEndWords(handover: EndedHandover, stoppedBy: string | null): Words | null {
  const { kind, from, to, yours, ended } = handover;
  const other = nameWords(yours ? to : from);
  const what = kind === 'ask' ? 'request for the drive' : 'offer of the drive';
  const whose = yours ? `Your ${what}` : `${other}’s ${what}`;
  switch (ended) {
    case 'accepted':
      return acceptedWords(handover, other);
    case 'refused':
      return yours
        ? { text: `${other} has refused: the drive has not changed hands.`, tone: 'warning' }
        : { text: 'Refused: the drive has not changed hands.', tone: 'neutral' };
    case 'withdrawn':
      return { text: `${whose} was taken back.`, tone: 'neutral' };
    case 'expired':
      return yours
        ? { text: `${other} did not answer: the drive has not changed hands.`, tone: 'warning' }
        : { text: `You did not answer ${other}: the drive has not changed hands.`, tone: 'neutral' };
    case 'driver-changed':
      // Whoever drove has given the drive up, or is told who has taken it.
      return (kind === 'offer') === yours
        ? null
        : { text: `${whose} has ended: the driver has changed.`, tone: 'neutral' };
    case 'left':
      return { text: `${whose} has ended: ${other} has left.`, tone: 'neutral' };
    case 'estop':
      return { text: `${whose} has ended: ${stoppedBy ?? 'an operator'} pressed STOP.`, tone: 'warning' };
  }
}

function acceptedWords({ kind, yours }: EndedHandover, other: string): Words {
  if ((kind === 'ask') === yours) {
    const how = yours ? `${other} has accepted: you drive now.` : `You drive now, by ${other}’s offer.`;
    return { text: `${how} Press the grip anew to drive.`, tone: 'good' };
  }
  return { text: `${yours ? `${other} has accepted: ` : ''}${other} drives now.`, tone: 'neutral' };
}
