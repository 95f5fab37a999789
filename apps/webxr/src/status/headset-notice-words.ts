/** What stands before the operator's eyes in the headset: all that the flat page says in its middle and its notices. */
import type { Failure } from '../state/notices.ts';
import type { Banner } from './banner-words.ts';
import type { Words } from './tone.ts';

export interface HeadsetNoticeFacts {
  failure: Failure | null;
  /** The link is gone. */
  banner: Banner | null;
  /** What keeps the page from connecting. */
  obstacle: Failure | null;
  /** The operator holds the grip, and the robot stands still all the same: why; `null` if it does not. */
  held: Words | null;
  /** The emergency stop is on. */
  stop: { atRobot: boolean; by: 'operator' | 'robot' | null } | null;
  /** What another operator asks or offers; `null` if none does. */
  asked: string | null;
  /** Disappears by itself. */
  notice: Words | null;
}

export interface HeadsetNotice {
  /** What holds now; `null` if nothing does. */
  standing: { title: string | null; text: string; tone: Words['tone'] } | null;
  passing: Words | null;
}

export function headsetNotice(facts: HeadsetNoticeFacts): HeadsetNotice {
  const standing = standingOf(facts);
  const { notice } = facts;
  // When a link is lost, the notice and what stands say the same.
  const isSaid = notice !== null && standing?.text.includes(notice.text) === true;
  return { standing, passing: isSaid ? null : notice };
}

function standingOf(facts: HeadsetNoticeFacts): HeadsetNotice['standing'] {
  const { failure, banner, obstacle, held, stop, asked } = facts;
  const severe = failure ?? banner ?? obstacle;
  if (severe !== null) return { title: severe.title, text: severe.text, tone: 'bad' };
  if (stop !== null) return { title: stopTitle(stop.by), text: releaseWords(stop.atRobot), tone: 'bad' };
  if (held !== null) return { title: null, ...held };
  return asked === null ? null : { title: asked, text: 'Answer in the menu.', tone: 'warning' };
}

function stopTitle(by: 'operator' | 'robot' | null): string {
  if (by === null) return 'STOP is on';
  return `STOP is on (by ${by === 'robot' ? 'the robot' : 'an operator'})`;
}

function releaseWords(atRobot: boolean): string {
  return atRobot
    ? 'It can be released at the robot only.'
    : 'To release it, open both hands and hold a trigger for one second.';
}
