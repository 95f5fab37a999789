/**
 * The one banner in the middle of the screen: the link is gone, the robot does not hear, or a hand holds on in vain. It says what
 * has happened and what to do. What asks the operator for a decision first has a panel of its own.
 */
import { finalLosses, type SessionLoss, type SessionPhase, type SignalingState } from '@farpoint/operator';
import type { Silence } from '../ground/silence.ts';
import { type HandFacts, vainGripWords } from './driving-words.ts';
import { texts } from './language.ts';
import { type LossFacts, wordsOfLoss } from './words.ts';

export interface Banner {
  readonly title: string;
  readonly text: string;
  /** Whether it interrupts what is being read aloud. */
  readonly urgent: boolean;
}

export interface BannerFacts extends HandFacts, LossFacts {
  phase: SessionPhase;
  /** For how long nothing has come from the robot. */
  silence: Silence;
  /** Whether the robot has not answered for long: it may not hear this page, although the page hears it. */
  interrupted: boolean;
  signaling: SignalingState;
  /** Whether the browser believes that it has a network. */
  online: boolean;
  /** Whether the signaling service lists the chosen robot. */
  robotListed: boolean;
  robotId: string | null;
  /** Why the last session ended; `null` if none has. */
  lastLoss: SessionLoss | null;
  /** Whether the operator holds a grip. */
  gripped: boolean;
}

type Said = Omit<Banner, 'urgent'>;

/** `null` while there is nothing to say. */
export function bannerWords(facts: BannerFacts): Banner | null {
  if (facts.phase === 'live') {
    const lost = liveLoss(facts);
    if (lost !== null) return urgent(lost, facts.gripped);
    const vain = vainGripWords(facts);
    return vain === null ? null : { ...vain, urgent: false };
  }
  if (facts.phase === 'none') return null;
  if (facts.lastLoss !== null && finalLosses.has(facts.lastLoss)) return null;
  const words = facts.lastLoss === null ? beforeSession(facts) : afterLoss(facts, facts.lastLoss);
  return words === null ? null : urgent(words, facts.gripped);
}

/** Which side is gone: the signaling service sees both. */
function liveLoss({ silence, interrupted, signaling, online, robotListed }: BannerFacts): Said | null {
  const said = texts().link.banner;
  if (silence === 'lost') {
    if (!online || signaling !== 'ready') return { title: said.yours, text: said.yoursText };
    if (!robotListed) return { title: said.gone, text: said.goneText };
    return { title: said.silent, text: said.silentText };
  }
  if (!interrupted || silence !== 'heard') return null;
  return { title: said.deaf, text: said.deafText };
}

/** A robot was chosen, and has never been reached. */
function beforeSession({ phase, signaling, robotListed, robotId }: BannerFacts): Said | null {
  if (phase !== 'waiting') return null;
  const said = texts().link;
  if (signaling === 'waiting' || signaling === 'refused')
    return { title: said.banner.noService, text: said.signaling[signaling] };
  if (signaling !== 'ready' || robotListed) return null;
  return { title: said.banner.notOnline, text: said.banner.notOnlineText(robotId ?? '') };
}

function afterLoss(facts: BannerFacts, loss: SessionLoss): Said {
  const { signaling, robotListed, online } = facts;
  const { banner: said, signaling: states } = texts().link;
  if (!online || (signaling !== 'ready' && signaling !== 'connecting'))
    return { title: said.yours, text: said.yoursAfter(states[signaling]) };
  if (loss === 'robot-full') return { title: said.full, text: wordsOfLoss(loss, facts) };
  if (!robotListed) return { title: said.offline, text: wordsOfLoss(loss, facts) };
  return { title: said.notConnected, text: wordsOfLoss(loss, facts) };
}

function urgent({ title, text }: Said, gripped: boolean): Banner {
  return { title, text: gripped ? `${text} ${texts().driving.letGo}` : text, urgent: true };
}
