/** Requests for the drive and offers of it, in words. */
import type { Handover, HandoverEnd, LeaseState, NamedOperator, Operators } from '@farpoint/operator';
import { texts } from './language.ts';
import type { Words } from './words.ts';

type Named = Pick<Handover, 'kind' | 'from' | 'to'>;

/** @param claimed nothing proves the name */
export function nameWords({ name, claimed }: Pick<NamedOperator, 'name' | 'claimed'>): string {
  return claimed === true ? texts().people.claimed(name) : name;
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
  const said = texts().people;
  return kind === 'ask'
    ? { text: said.asks(name), accept: said.give, refuse: said.refuse }
    : { text: said.offers(name), accept: said.take, refuse: said.refuse };
}

/** What this operator waits for. */
export function waitingWords({ kind, to }: Named): string {
  const name = nameWords(to);
  const said = texts().people;
  return kind === 'ask' ? said.youAsked(name) : said.youOffered(name);
}

export type EndedHandover = Named & { yours: boolean; ended: HandoverEnd };

/**
 * What has become of it, for whoever made it or was to answer it; `null` if that operator knows.
 *
 * @param stoppedBy who pressed STOP, as the page names others; `null` if it does not say
 */
export function handoverEndWords(handover: EndedHandover, stoppedBy: string | null): Words | null {
  const { kind, from, to, yours, ended } = handover;
  const said = texts().people;
  const other = nameWords(yours ? to : from);
  const what = kind === 'ask' ? askOf(yours, other) : offerOf(yours, other);
  switch (ended) {
    case 'accepted':
      return acceptedWords(handover, other);
    case 'refused':
      return yours
        ? { text: said.hasRefused(other), tone: 'warning' }
        : { text: said.refused, tone: 'neutral' };
    case 'withdrawn':
      return { text: said.takenBack(what), tone: 'neutral' };
    case 'expired':
      return yours
        ? { text: said.noAnswer(other), tone: 'warning' }
        : { text: said.youNoAnswer(other), tone: 'neutral' };
    case 'driver-changed':
      // Whoever drove has given the drive up, or is told who has taken it.
      return (kind === 'offer') === yours ? null : { text: said.driverChanged(what), tone: 'neutral' };
    case 'left':
      return { text: said.hasLeft(what, other), tone: 'neutral' };
    case 'estop':
      return { text: said.stopped(what, stoppedBy ?? said.presser.anOperator), tone: 'warning' };
  }
}

function askOf(yours: boolean, other: string): string {
  return yours ? texts().people.yourAsk : texts().people.theirAsk(other);
}

function offerOf(yours: boolean, other: string): string {
  return yours ? texts().people.yourOffer : texts().people.theirOffer(other);
}

function acceptedWords({ kind, yours }: EndedHandover, other: string): Words {
  const said = texts().people;
  if ((kind === 'ask') === yours)
    return { text: yours ? said.youDriveNow(other) : said.youDriveByOffer(other), tone: 'good' };
  return { text: yours ? said.acceptedDrives(other) : said.drivesNow(other), tone: 'neutral' };
}
