/** Requests for the drive and offers of it, in words. */
import type { Handover, HandoverEnd, NamedOperator } from '@farpoint/operator';
import type { Words } from './tone.ts';

type Named = Pick<Handover, 'kind' | 'from' | 'to'>;

/** @param claimed nothing proves the name */
export function nameWords({ name, claimed }: Pick<NamedOperator, 'name' | 'claimed'>): string {
  return claimed === true ? `“${name}”` : name;
}

/** What another operator wants, and the two answers. */
export function askedWords({ kind, from }: Named): { text: string; accept: string; refuse: string } {
  const name = nameWords(from);
  return kind === 'ask'
    ? { text: `${name} asks to drive`, accept: 'Give the drive', refuse: 'Refuse' }
    : { text: `${name} offers you the drive`, accept: 'Take the drive', refuse: 'Refuse' };
}

/** The two answers in the headset's menu; `null`: nothing is asked. */
export function menuAnswers(
  asked: (Named & { id: number }) | null,
): { id: number; accept: string; refuse: string } | null {
  if (asked === null) return null;
  const name = nameWords(asked.from);
  const { id, kind } = asked;
  return kind === 'ask'
    ? { id, accept: `Give the drive to ${name}`, refuse: `Refuse ${name} the drive` }
    : { id, accept: `Take the drive from ${name}`, refuse: `Refuse the drive from ${name}` };
}

/** How this operator takes back what it waits for, in the headset's menu; `null`: it waits for nothing. */
export function menuTakeBack(
  waiting: (Named & { id: number }) | null,
): { id: number; takeBack: string } | null {
  if (waiting === null) return null;
  const { id, kind, to } = waiting;
  const name = nameWords(to);
  return { id, takeBack: kind === 'ask' ? `Ask ${name} no more` : `Take back the offer to ${name}` };
}

/** What this operator waits for. */
export function waitingWords({ kind, to }: Named): string {
  const name = nameWords(to);
  return kind === 'ask' ? `You have asked ${name} for the drive` : `You have offered ${name} the drive`;
}

/** What has become of it, for whoever made it or was to answer it. */
export function handoverEndWords(handover: Named & { yours: boolean; ended: HandoverEnd }): Words {
  const { kind, from, to, yours, ended } = handover;
  const other = nameWords(yours ? to : from);
  if (ended === 'accepted') {
    return (kind === 'ask') === yours
      ? { text: `${other} has handed you the drive. Press the grip anew to drive.`, tone: 'good' }
      : { text: `${other} drives now.`, tone: 'neutral' };
  }
  const what = kind === 'ask' ? 'request for the drive' : 'offer of the drive';
  const whose = yours ? `Your ${what}` : `${other}’s ${what}`;
  switch (ended) {
    case 'refused':
      return yours
        ? { text: `${other} has refused: the drive has not changed hands.`, tone: 'warning' }
        : { text: 'Refused: the drive has not changed hands.', tone: 'neutral' };
    case 'withdrawn':
      return { text: `${whose} was taken back.`, tone: 'neutral' };
    case 'expired':
      return { text: `${whose} was not answered in time.`, tone: yours ? 'warning' : 'neutral' };
    case 'driver-changed':
      return { text: `${whose} has ended: somebody else drives, or nobody.`, tone: 'neutral' };
    case 'left':
      return { text: `${whose} has ended: ${other} has left.`, tone: 'neutral' };
    case 'estop':
      return { text: `${whose} has ended: STOP was pressed.`, tone: 'warning' };
  }
}
