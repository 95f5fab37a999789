/** What stands in the middle of the screen when the link is gone, or a hand holds on in vain: what happened, and what to do. */
import { finalLosses } from '@farpoint/operator';
import { type HandFacts, vainGripWords } from './driving-words.ts';
import { LOST_MS } from './silence.ts';
import { type LinkFacts, wordsOfLoss } from './words.ts';

export interface Banner {
  readonly title: string;
  readonly text: string;
  /** Whether it interrupts what is being read aloud. */
  readonly urgent: boolean;
}

type BannerFacts = Pick<LinkFacts, 'phase' | 'robotListed' | 'lastLoss' | 'silentMs' | 'maxOperators'> & {
  /** What the robot said about the loss; `null` if nothing. */
  lossDetail: string | null;
  /** Whether the operator holds a grip. */
  gripped: boolean;
} & HandFacts;

const SILENT: Banner = {
  title: 'Connection lost',
  text: 'The robot stops by itself. This page keeps trying to reach it; STOP is kept for its return.',
  urgent: true,
};
const LET_GO = ' Let go of the grip.';

/** `null` while there is nothing to say. What asks the operator to do something first has a panel of its own. */
export function bannerWords(facts: BannerFacts): Banner | null {
  const { phase, silentMs, lastLoss, robotListed } = facts;
  if (phase === 'live') {
    if (silentMs >= LOST_MS) return withGrip(SILENT, facts.gripped);
    const vain = vainGripWords(facts);
    return vain === null ? null : { ...vain, urgent: false };
  }
  // Until the first session there is nothing to lose.
  if (phase === 'none' || lastLoss === null || finalLosses.has(lastLoss)) return null;
  const title = robotListed ? 'Not connected' : 'The robot is offline';
  return withGrip({ title, text: wordsOfLoss(lastLoss, facts), urgent: true }, facts.gripped);
}

function withGrip(banner: Banner, gripped: boolean): Banner {
  return gripped ? { ...banner, text: banner.text + LET_GO } : banner;
}
