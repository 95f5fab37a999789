/**
 * The `session` channel, opened by the robot, ordered and reliable: who drives, what the stream is, what was refused.
 */
import type { Alarm } from './alarm.ts';
import type { CloudFormat } from './cloud-format.ts';
import type { CommandRejection } from './control.ts';
import type { EstopCause } from './estop-cause.ts';
import type { Handover } from './handover.ts';
import type { Pointed, Pointing } from './pointing.ts';
import type { Operators, Role } from './present-operators.ts';
import type { Quantity } from './quantity.ts';
import type { RobotAbout } from './robot-about.ts';
import type { RobotBody } from './robot-body.ts';
import type { CommandRefused, CommandRun, RecordingState, RobotCommand } from './robot-command.ts';
import type { RobotModelParts } from './robot-model.ts';
import type { SensorRings } from './sensor-rings.ts';
import type { MicrophoneState, VoiceState } from './sound-media.ts';
import type { Videos } from './video-media.ts';

/** The robot's drive limits. No message can raise any of them. */
export interface DriveLimits {
  /** m/s, forward and backward. */
  maxLinear: number;
  /**
   * m/s, to the left and to the right; left out: 0, the base cannot go sideways. The whole planar velocity is never above the
   * greater of this and `maxLinear`.
   */
  maxLateral?: number | undefined;
  /** rad/s. */
  maxAngular: number;
  /** Without a fresh command for this long, the robot brakes to zero. */
  watchdogMs: number;
  /** The most commands per second that are read. */
  maxCommandsPerSecond: number;
}

/** After a longer gap no robot moves on by itself, whatever its configuration, ms. */
export const MOST_RESUME_MS = 1000;

/** What a robot does when commands come again after a gap that stopped it. */
export const afterGapChoices = [
  'resume', // it moves again at once, after a gap of less than 1 s
  'let-go', // it moves again once the operator has let go of the grip, unless the gap was very short
] as const;
/**
 * What a robot does when commands come again after a gap that stopped it.
 *
 * @useDeclaredType
 */
export type AfterGap = (typeof afterGapChoices)[number];

/** The robot's first message in every session. */
export interface Welcome {
  type: 'welcome';
  /** Version of the protocol that the robot speaks. */
  protocol: number;
  /** The robot's id at the signaling service. */
  robotId: string;
  /** The robot's name, for people. */
  name: string;
  /** What the robot allows. */
  limits: DriveLimits & {
    /** Left out by older robots, which resume. */
    afterGap?: AfterGap | undefined;
    /**
     * After a shorter gap the robot moves on by itself if the hand has held on, ms. Left out by older robots, which know no
     * command that is `unread`.
     */
    resumeWithinMs?: number | undefined;
  };
  /** What the robot takes of the floor, and how it stops. Left out by older robots. */
  body?: RobotBody | undefined;
  /** The first sensor's clouds before they are sampled. */
  stream: {
    /** The format that every operator reads. */
    format: 'points64';
    /** Of the raw cloud, points; those of the camera's picture where there is one. */
    width: number;
    /** Of the raw cloud, points. */
    height: number;
    /** Frames captured a second. */
    framesPerSecond: number;
  };
  /** Proves to the robot that a `session.resume` comes from this session's operator. Left out: it cannot be resumed. */
  resumeKey?: string | undefined;
  /** What the operator's grant says. Left out by robots that ask for none: then everybody may drive. */
  access?:
    | {
        /** What the operator may do. */
        role: Role;
        /** The operator's name, by the grant. */
        name: string;
        /** When the grant ends, seconds from now. */
        expiresInS: number;
      }
    | undefined;
}

/**
 * A grant that ends within this time ends soon, s: the robot warns its operator, and the page speaks of it. Chosen: long
 * enough to stand still and to renew a grant.
 */
export const GRANT_ENDS_SOON_S = 60;

/** The operator's grant ends soon, and the session with it. */
export interface GrantExpires {
  type: 'expires';
  /** Seconds from now. */
  inS: number;
}

/** Who may drive. */
export interface LeaseState {
  type: 'lease';
  /** Who holds the lease. */
  holder: 'you' | 'other' | 'nobody';
  /** Names the lease in commands; there only for the operator who holds it. */
  lease?: string | undefined;
  /** The holder's name, by its grant. Left out if nobody drives, and by robots that ask for no grant. */
  driver?: string | undefined;
}

/** The robot refused a command. */
export interface CommandRejected {
  type: 'rejected';
  /** The command's sequence number, if it was readable. */
  sequence?: number | undefined;
  /** Why it was refused, for programs. */
  reason: CommandRejection;
  /** For people: what is wrong and where. */
  detail: string;
  /** How many were refused for this reason since the last such message; these are sent at most 10 times per second. */
  count: number;
}

/** The emergency stop. */
export interface EstopState {
  type: 'estop';
  /** Whether it is latched: the robot does not move. */
  latched: boolean;
  /** Who latched it first, if it is latched. */
  by?: 'operator' | 'robot' | undefined;
  /** `robot`: a stop at the robot itself holds it, and it can be released only there. */
  releasedAt?: 'robot' | undefined;
  /**
   * Number of the latest latch, 0 before the first. A press while it is latched counts as well. Left out by robots that
   * do not number them.
   */
  latch?: number | undefined;
  /** The newest of this operator's presses that has latched it in this session. */
  press?: number | undefined;
}

/** Announces the frame that answers a latency test. */
export interface LatencyFrame {
  type: 'latencyFrame';
  /** Number of the test, as the command had it. */
  id: number;
  /** The frame that answers. */
  frameNumber: number;
  /** Points that are sent of it. */
  points: number;
  /** When the command came, by the robot's monotonic clock, ms. */
  commandMs: number;
  /** When the frame was captured, by the robot's monotonic clock, ms. */
  captureMs: number;
}

/**
 * The parameters for decoding packets of a coded format. Sent before the first such packet, and again whenever they
 * change. A receiver that cannot use them sends `cloudFormats` without that format.
 */
export interface CloudStream {
  type: 'cloudStream';
  format: Exclude<CloudFormat, 'points64'>;
  /** The format's own stream header, base64. */
  header: string;
  /** Which sensor's clouds; if absent, those of sensor 0. */
  sensor?: number | undefined;
}

/**
 * The robot's cameras whose pictures it can send; a camera's position in the list is its number. Follows the welcome.
 */
export interface Cameras {
  type: 'cameras';
  /** In the order of their numbers. */
  cameras: {
    /** For people. */
    name: string;
  }[];
}

/**
 * The sensors whose clouds the robot can send; a sensor's position in the list is its number in the placement. Sent
 * after the welcome by robots with more than one sensor.
 */
export interface Sensors {
  type: 'sensors';
  /** In the order of their numbers. */
  sensors: {
    /** For people. */
    name: string;
  }[];
}

/**
 * The robot's microphone and loudspeaker, as far as this operator is concerned. Sent after the welcome by robots that
 * have either, and again whenever something changes.
 */
export interface Sound {
  type: 'sound';
  /** `a=mid` of its m-line in the robot's offer. */
  mid: string;
  /** What the operator gets of the microphone; absent if the robot has none. */
  microphone?:
    | {
        /** For programs. */
        state: MicrophoneState;
        /** For people: why there is no sound. */
        detail?: string | undefined;
      }
    | undefined;
  /** What the robot does with the operator's voice; absent if the robot has no loudspeaker. */
  voice?:
    | {
        /** For programs. */
        state: VoiceState;
        /** For people: why it is not played. */
        detail?: string | undefined;
      }
    | undefined;
}

/** Why the robot did not do what an operator asked. */
export const faultReasons = [
  'not-permitted', // the grant's role does not permit it
  'unknown-operator', // no operator has this number now
  'own-session', // it is the asker's own, which it can leave, or which drives already
  'rate-limited', // too many such requests
  'no-room', // no more grants can be blocked
  'newer-latch', // the release meant an older latch of the emergency stop, or may have meant one
  'held-at-robot', // a stop at the robot itself is on: the emergency stop is released there
  'not-latcher', // the emergency stop is released by those who latched it
  'not-driver', // only who drives offers the drive
  'nobody-drives', // there is nobody to ask: the lease is free
  'only-watches', // the other operator may not drive
  'already-open', // the operator has a request or an offer that is not answered yet
  'not-open', // the request or offer can no longer be answered, or never could by this operator
  'estop', // the drive is not handed over while the emergency stop is latched
] as const;
/**
 * Why the robot did not do what an operator asked.
 *
 * @useDeclaredType
 */
export type FaultReason = (typeof faultReasons)[number];

/** A message of the operator, other than a command, that the robot could not use. */
export interface SessionFault {
  type: 'fault';
  message: string;
  /** For programs, where a request was refused rather than misunderstood. */
  reason?: FaultReason | undefined;
}

export type RobotSessionMessage =
  | Welcome
  | LeaseState
  | CommandRejected
  | EstopState
  | EstopCause
  | RobotAbout
  | LatencyFrame
  | CloudStream
  | Cameras
  | Sensors
  | SensorRings
  | Videos
  | Sound
  | RobotModelParts
  | Quantity
  | Alarm
  | GrantExpires
  | Operators
  | Handover
  | RobotCommand
  | CommandRun
  | CommandRefused
  | RecordingState
  | Pointing
  | Pointed
  | SessionFault;

export const PROTOCOL_VERSION = 1;
