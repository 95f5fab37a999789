/** All the texts with which the page describes a state, a refusal or a failure to people. */

import {
  type DriveInput,
  finalLosses,
  type GripLoss,
  type SessionLoss,
  type SessionPhase,
  type SignalingState,
  type StopStatus,
} from '@farpoint/operator';
import {
  type CommandRejection,
  type DriveState,
  GRANT_ENDS_SOON_S,
  type LeaseState,
  type Role,
  type Telemetry,
} from '@farpoint/protocol';
import type { SignalingFault } from '../ground/settings.ts';
import type { Silence } from '../ground/silence.ts';
import { texts } from './language.ts';

/** How urgent a text is: its colour. */
export type Tone = 'good' | 'neutral' | 'warning' | 'bad';

export interface Words {
  text: string;
  tone: Tone;
}

const driveTones: Record<DriveState, Tone> = {
  driving: 'good',
  idle: 'neutral',
  watchdog: 'warning',
  estop: 'bad',
  blocked: 'warning',
};

/** What the robot does, and what it waits for. */
export function driveStateWords({ drive, motion }: Pick<Telemetry, 'drive' | 'motion'>): Words {
  const said = texts().driving;
  const stands = drive === 'watchdog' || drive === 'idle';
  if (stands && motion?.letGoFirst === true) return { text: said.stoppedByGap, tone: 'warning' };
  return { text: said.states[drive], tone: driveTones[drive] };
}

const stopTones: Record<Exclude<StopStatus, 'none'>, Tone> = {
  unconfirmed: 'warning',
  confirmed: 'good',
  undelivered: 'bad',
};

/** What has become of STOP; `null` if there is nothing to say. */
export function stopWords(status: StopStatus): Words | null {
  return status === 'none' ? null : { text: texts().driving.stop[status], tone: stopTones[status] };
}

/** Why the robot refused a command. @param holder who may drive, as far as the page knows */
export function wordsOfRejection(reason: CommandRejection, holder: LeaseState['holder']): string {
  const { rejections, turnEnded } = texts().driving;
  return reason === 'not-lease-holder' && holder !== 'other' ? turnEnded : rejections[reason];
}

/** Why the address of the signaling service cannot be used, in the line of the link. */
export function signalingFaultWords({ reason, address }: SignalingFault): string {
  const { link, settings } = texts();
  return link.addressFault(settings.addressFaults[reason](address));
}

const signalingTones: Record<SignalingState, Tone> = {
  connecting: 'neutral',
  ready: 'good',
  waiting: 'warning',
  refused: 'bad',
  stopped: 'neutral',
};

function signalingWords(state: SignalingState): Words {
  return { text: texts().link.signaling[state], tone: signalingTones[state] };
}

export interface DrivingFacts {
  /** Whether the robot is heard and hears, in a session: otherwise nobody here drives it. */
  heard: boolean;
  holder: LeaseState['holder'];
  /** The driver's name, by its grant. */
  driver: string | null;
  /** What this operator's grant allows; `null` if the robot asks for none. */
  role: Role | null;
  /** The device that this operator drives with, '' while it is not known; `null` while no grip is held. */
  device: DriveInput['name'] | '' | null;
  /** Why a grip that is held does not drive; `null` if there is none. */
  gripLost: GripLoss | null;
  /** Whether the grip that drives was not read for a moment. */
  paused: boolean;
  /** Whether the emergency stop is latched. */
  stopped: boolean;
}

/** Who drives. */
export function holderWords({
  heard,
  holder,
  driver,
  role,
  device,
  gripLost,
  paused,
  stopped,
}: DrivingFacts): Words {
  const { holder: said, devices } = texts().driving;
  if (!heard) return { text: said.unheard, tone: 'bad' };
  if (holder === 'other') return { text: said.otherDrives(driver ?? said.someoneElse), tone: 'warning' };
  if (stopped && (device !== null || gripLost !== null)) return { text: said.stopIsOn, tone: 'bad' };
  if (role === 'watch') return { text: said.nobodyYouWatch, tone: 'neutral' };
  if (gripLost !== null && device === null) return { text: said.letGo, tone: 'warning' };
  if (paused) return { text: said.paused, tone: 'warning' };
  if (holder === 'nobody') return { text: said.nobody, tone: 'neutral' };
  if (device === null) return { text: said.youHaveControl, tone: 'good' };
  return { text: said.youDrive(device === '' ? '' : devices[device]), tone: 'good' };
}

/** What is known of a loss besides its kind. */
export interface LossFacts {
  /** How many operators the robot takes; `null` if it has not said so. */
  maxOperators: number | null;
  /** What the robot said about it; `null` if nothing. */
  lossDetail: string | null;
}

/** Why a session ended. */
export function wordsOfLoss(loss: SessionLoss, { maxOperators, lossDetail }: LossFacts): string {
  if (loss === 'robot-full') return fullWords(maxOperators, lossDetail);
  const said = texts().link;
  // Who did it is what matters.
  if (loss === 'ended-by-supervisor' && lossDetail !== null) return said.endedBy(lossDetail);
  return said.loss[loss];
}

function fullWords(maxOperators: number | null, detail: string | null): string {
  const said = texts().link;
  // Why there is no place for this operator in particular.
  if (detail !== null) return said.noPlace(detail);
  return maxOperators === null ? said.full : said.fullOf(maxOperators);
}

export interface LinkFacts {
  phase: SessionPhase;
  signaling: SignalingState;
  robotListed: boolean;
  /** Why the last session ended. */
  lastLoss: SessionLoss | null;
  /** How many operators the robot takes; `null` if it has not said so. */
  maxOperators: number | null;
  /** What the robot said about the last session's end; `null` if nothing. */
  lossDetail: string | null;
  /** Until the operator's grant ends, ms; `null` if the robot asks for none. */
  grantLeftMs: number | null;
  /** Time since the last message or point from the robot, ms, and what that means. */
  silentMs: number;
  silence: Silence;
  /** Time since the last point, ms. */
  pointsSilentMs: number;
  /** The robot plays files. */
  plays: boolean;
  /** The robot learns the path's state from receiver reports only. */
  rateByReports: boolean;
}

/**
 * Without points for so long, the link's line says so, ms. Chosen: points may be missing while a sensor starts or a link
 * is narrow. status.test.ts holds it.
 */
const NO_POINTS_MS = 3000;

/** The state of the link in one line. */
export function linkWords(facts: LinkFacts): Words {
  const said = texts().link;
  switch (facts.phase) {
    case 'none':
      return signalingWords(facts.signaling);
    case 'waiting':
      if (facts.signaling !== 'ready') return signalingWords(facts.signaling);
      if (!facts.robotListed) return { text: said.offline, tone: 'warning' };
      if (facts.lastLoss !== null && finalLosses.has(facts.lastLoss))
        return { text: wordsOfLoss(facts.lastLoss, { maxOperators: null, lossDetail: null }), tone: 'bad' };
      return facts.lastLoss === 'robot-full'
        ? { text: fullWords(facts.maxOperators, facts.lossDetail), tone: 'warning' }
        : { text: said.connecting, tone: 'neutral' };
    case 'opening':
      return { text: said.opening, tone: 'neutral' };
    case 'live':
      return liveWords(facts);
  }
}

function liveWords(facts: LinkFacts): Words {
  const said = texts().link;
  // The banner says what to do.
  if (facts.silence === 'lost')
    return { text: said.lostFor(Math.max(1, Math.round(facts.silentMs / 1000))), tone: 'bad' };
  if (facts.silence === 'unheard') return { text: said.nothingComes, tone: 'warning' };
  const grantEnds = grantEndsWords(facts.grantLeftMs);
  if (grantEnds !== null) return grantEnds;
  if (facts.pointsSilentMs >= NO_POINTS_MS) return { text: said.noPoints, tone: 'warning' };
  if (facts.signaling !== 'ready') return { text: said.liveWithoutSignaling, tone: 'good' };
  if (facts.rateByReports) return { text: said.cautious, tone: 'warning' };
  return { text: facts.plays ? said.playback : said.live, tone: 'good' };
}

/** Why VR is unavailable; `null` if it is available. */
export function vrUnavailable(facts: {
  secure: boolean;
  hasWebXr: boolean;
  supported: boolean;
}): string | null {
  const said = texts().headset;
  if (facts.supported) return null;
  if (!facts.secure) return said.needsHttps;
  return facts.hasWebXr ? said.noHeadset : said.noWebXr;
}

/** @returns `null` unless the grant ends soon */
export function grantEndsWords(leftMs: number | null): Words | null {
  if (leftMs === null || leftMs > GRANT_ENDS_SOON_S * 1000) return null;
  const seconds = Math.max(0, Math.ceil(leftMs / 1000));
  return { text: texts().link.grantEndsAndThen(seconds), tone: 'warning' };
}
