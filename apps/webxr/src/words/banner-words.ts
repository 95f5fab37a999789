/**
 * The one banner in the middle of the screen: the link is gone, the robot does not hear, or a hand holds on in vain. It says what
 * has happened and what to do. What asks the operator for a decision first has a panel of its own.
 */
import { finalLosses, type SessionLoss, type SessionPhase, type SignalingState } from '@farpoint/operator';
import type { Silence } from '../ground/silence.ts';
import { type HandFacts, vainGripWords } from './driving-words.ts';
import { texts } from './language.ts';
import { type LossFacts, signalingWords, wordsOfLoss } from './words.ts';

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

const STOPS = 'The robot stops by itself.';
const RETRIES = 'This page keeps trying; a STOP that you press now is kept for then.';

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
  if (silence === 'lost') {
    if (!online || signaling !== 'ready')
      return {
        title: 'Your connection is lost',
        text: `Neither the robot nor the signaling service reaches this computer: check its network. ${STOPS} ${RETRIES}`,
      };
    if (!robotListed)
      return {
        title: 'The robot is gone',
        text: `Its program or its network is down: the signaling service does not see it, either. ${STOPS} This page connects again when it is back.`,
      };
    return { title: 'The robot does not answer', text: `The connection to it is lost. ${STOPS} ${RETRIES}` };
  }
  if (!interrupted || silence !== 'heard') return null;
  return {
    title: 'The robot does not hear you',
    text: `You see it live, but nothing that you send arrives. ${STOPS} ${RETRIES}`,
  };
}

/** A robot was chosen, and has never been reached. */
function beforeSession({ phase, signaling, robotListed, robotId }: BannerFacts): Said | null {
  if (phase !== 'waiting') return null;
  if (signaling === 'waiting' || signaling === 'refused')
    return { title: 'No signaling service', text: signalingWords[signaling].text };
  if (signaling !== 'ready' || robotListed) return null;
  return {
    title: 'This robot is not online',
    text: `The signaling service does not list “${robotId ?? ''}”. This page connects when it appears; press Disconnect to choose another robot.`,
  };
}

function afterLoss(facts: BannerFacts, loss: SessionLoss): Said {
  const { signaling, robotListed, online } = facts;
  if (!online || (signaling !== 'ready' && signaling !== 'connecting'))
    return { title: 'Your connection is lost', text: `${STOPS} ${signalingWords[signaling].text}` };
  if (loss === 'robot-full') return { title: 'The robot is full', text: wordsOfLoss(loss, facts) };
  if (!robotListed) return { title: 'The robot is offline', text: wordsOfLoss(loss, facts) };
  return { title: 'Not connected', text: wordsOfLoss(loss, facts) };
}

function urgent({ title, text }: Said, gripped: boolean): Banner {
  return { title, text: gripped ? `${text} ${texts().driving.letGo}` : text, urgent: true };
}
