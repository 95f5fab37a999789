/** What stands before the operator's eyes in the headset: all that the flat page says in its middle and in its notices. */
import type { RobotListing, SignalingState } from '@farpoint/operator';
import type { Hand, HeadsetView } from '../ground/headset-settings.ts';
import type { Banner } from './banner-words.ts';
import type { LatchedStop } from './estop-words.ts';
import { viewHint, viewNotice } from './headset-words.ts';
import { texts } from './language.ts';
import { emptyListWords } from './robots-words.ts';
import type { Words } from './words.ts';

/** Something that keeps the page from working or from connecting. */
interface Obstruction {
  readonly title: string;
  readonly text: string;
}

export interface HeadsetNoticeFacts {
  /** What keeps the page from working. */
  failure: Obstruction | null;
  /** The link is gone, the robot does not hear, or a hand holds on in vain. */
  banner: Banner | null;
  /** What keeps the page from connecting. */
  obstacle: Obstruction | null;
  /** The emergency stop, while it is latched. */
  stop: LatchedStop | null;
  /** The operator holds the grip, and the robot stands still all the same: why; `null` if it does not. */
  held: Words | null;
  /** What another operator asks for or offers; `null` if nothing. */
  asked: string | null;
  /** Whether the menu is open, in which triggers choose. */
  menuOpen: boolean;
  /** What the operator does to have a robot; `null` once one is chosen. */
  choice: Words | null;
  /** Disappears by itself. */
  notice: Words | null;
  view: HeadsetView;
  /** The hand that drives. */
  driveHand: Hand;
}

export interface HeadsetNotice {
  /** What holds now; `null` if nothing does. */
  readonly standing: {
    readonly title: string | null;
    readonly text: string;
    readonly tone: Words['tone'];
  } | null;
  readonly passing: Words | null;
  /** What the hands do now; `null` if that has not changed. */
  readonly hint: string | null;
}

export function headsetNotice(facts: HeadsetNoticeFacts): HeadsetNotice {
  const { notice, view, driveHand } = facts;
  const standing = standingOf(facts);
  const passing = notice === null || isIdle(notice, standing) ? null : notice;
  const hint = passing?.text === viewNotice(view) ? viewHint(view, driveHand) : null;
  return { standing, passing, hint };
}

/** When a link is lost, the notice and what stands say the same, and that it was just made is no news any more. */
function isIdle({ text, tone }: Words, standing: HeadsetNotice['standing']): boolean {
  if (standing === null) return false;
  return standing.text.includes(text) || (tone === 'good' && standing.tone === 'bad');
}

function standingOf({
  failure,
  banner,
  obstacle,
  stop,
  held,
  asked,
  menuOpen,
  choice,
}: HeadsetNoticeFacts): HeadsetNotice['standing'] {
  const severe = failure ?? banner;
  if (severe !== null) return { title: severe.title, text: severe.text, tone: 'bad' };
  if (obstacle !== null)
    return { title: obstacle.title, text: texts().headset.answerOutside(obstacle.text), tone: 'bad' };
  if (stop !== null)
    return { title: texts().stop.title, text: `${stop.why} ${releaseWords(stop, menuOpen)}`, tone: 'bad' };
  if (held !== null) return { title: null, ...held };
  if (asked !== null) return { title: null, text: texts().headset.answer(asked), tone: 'warning' };
  return choice === null ? null : { title: texts().headset.noRobot, ...choice };
}

function releaseWords({ mayRelease, release }: LatchedStop, menuOpen: boolean): string {
  if (mayRelease && menuOpen) return texts().headset.releaseInMenu;
  return mayRelease ? texts().headset.release : release;
}

export interface ChoiceFacts {
  /** The robot that the stick chooses; `null` while none is listed. */
  next: Pick<RobotListing, 'name'> | null;
  /** Whether others are listed, too. */
  others: boolean;
  signaling: SignalingState;
  /** The signaling service's, for people. */
  host: string;
  /** The hand that drives. */
  driveHand: Hand;
}

/** What an operator does who wears the headset and has chosen no robot, or why there is none to choose. */
export function choiceWords({ next, others, signaling, host, driveHand }: ChoiceFacts): Words {
  const { headset } = texts();
  if (next === null) {
    const { text, tone } = emptyListWords(signaling, host);
    const isForSettings = signaling === 'refused' || signaling === 'waiting';
    return { text: isForSettings ? `${text} ${headset.settingsOutside}` : text, tone };
  }
  const press = headset.pressToConnect(headset.hands[driveHand], next.name);
  return { text: others ? `${press} ${headset.otherRobots}` : press, tone: 'neutral' };
}
