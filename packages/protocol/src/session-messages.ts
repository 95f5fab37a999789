/**
 * The `session` channel, opened by the robot, ordered and reliable: who drives, what the stream is, what was refused.
 */
import type { Alarm } from './alarm.ts';
import type { CloudFormat } from './cloud-format.ts';
import type { CommandRejection } from './control.ts';
import type { Quantity } from './quantity.ts';
import type { MicrophoneState, VoiceState } from './sound-media.ts';
import type { VideoCodec } from './video-media.ts';

/** The robot's drive limits. No message can raise any of them. */
export interface DriveLimits {
  /** m/s, forward and backward. */
  maxLinear: number;
  /** rad/s. */
  maxAngular: number;
  /** Without a fresh command for this long, the robot brakes to zero. */
  watchdogMs: number;
  /** The most commands per second that are read. */
  maxCommandsPerSecond: number;
}

/** The robot's first message in every session. */
export interface Welcome {
  /** Tells the message from others. */
  type: 'welcome';
  /** Version of the protocol that the robot speaks. */
  protocol: number;
  /** The robot's id at the signaling service. */
  robotId: string;
  /** The robot's name, for people. */
  name: string;
  /** What the robot allows. */
  limits: DriveLimits;
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
}

/** Who may drive. */
export interface LeaseState {
  /** Tells the message from others. */
  type: 'lease';
  /** Who holds the lease. */
  holder: 'you' | 'other' | 'nobody';
  /** Names the lease in commands; there only for the operator who holds it. */
  lease?: string | undefined;
}

/** The robot refused a command. */
export interface CommandRejected {
  /** Tells the message from others. */
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
  /** Tells the message from others. */
  type: 'estop';
  /** Whether it is latched: the robot does not move. */
  latched: boolean;
  /** Who latched it, if it is latched. */
  by?: 'operator' | 'robot' | undefined;
}

/** Announces the frame that answers a latency test. */
export interface LatencyFrame {
  /** Tells the message from others. */
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
  /** Tells the message from others. */
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
  /** Tells the message from others. */
  type: 'sensors';
  /** In the order of their numbers. */
  sensors: {
    /** For people. */
    name: string;
  }[];
}

/** One of the robot's cameras that is streamed as video on an m-line of its own. */
export interface VideoDescription {
  /** For people. */
  name: string;
  /** `a=mid` of its m-line in the robot's offer. */
  mid: string;
  /** What it is encoded with, for every operator. */
  codec: VideoCodec;
  /** Why there are no pictures at present, for people; absent while there are. */
  fault?: string | undefined;
}

/**
 * The videos of the robot's cameras; a video's position in the list is its number. Sent after the welcome by robots
 * with such cameras, and again whenever a video's state changes.
 */
export interface Videos {
  /** Tells the message from others. */
  type: 'videos';
  /** In the order of their numbers. */
  videos: VideoDescription[];
}

/**
 * The robot's microphone and loudspeaker, as far as this operator is concerned. Sent after the welcome by robots that
 * have either, and again whenever something changes.
 */
export interface Sound {
  /** Tells the message from others. */
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

/** A message of the operator, other than a command, that the robot could not use. */
export interface SessionFault {
  type: 'fault';
  message: string;
}

export type RobotSessionMessage =
  | Welcome
  | LeaseState
  | CommandRejected
  | EstopState
  | LatencyFrame
  | CloudStream
  | Cameras
  | Sensors
  | Videos
  | Sound
  | Quantity
  | Alarm
  | SessionFault;

/** Requests the lease. `take` asks to take over from another operator; the robot's policy decides. */
export interface LeaseRequest {
  type: 'leaseRequest';
  take: boolean;
}
export interface LeaseRelease {
  type: 'leaseRelease';
}
/** Latches or releases the emergency stop. Anyone may latch it; only the lease holder may release it. */
export interface EstopRequest {
  type: 'estop';
  latch: boolean;
}
/** Starts or pauses the stream of points to this operator. */
export interface StreamRequest {
  type: 'stream';
  running: boolean;
}

/** The formats that the operator reads. Before this message it gets `points64`, which may be sent to it at any time. */
export interface CloudFormats {
  type: 'cloudFormats';
  formats: CloudFormat[];
}

/** The cameras whose pictures the operator wants from now on, by number. Before this message, none are sent. */
export interface Pictures {
  type: 'pictures';
  cameras: number[];
}

/**
 * The sensors whose clouds the operator wants from now on, by number. Before this message it gets those of sensor 0.
 */
export interface WantedSensors {
  type: 'sensors';
  sensors: number[];
}

/** The videos that the operator wants from now on, by number. Before this message, none are sent. */
export interface WantedVideos {
  type: 'videos';
  videos: number[];
  /** Draws the capture time into their pictures, for everyone who watches: to measure latency. */
  barcode?: boolean | undefined;
}

/**
 * How the operator wants its link divided among the streams that want more than it carries. Weights are relative, 1–100.
 * A stream that needs less than its share leaves the rest to the others. Messages and what keeps the robot safe always
 * come first.
 */
export interface LinkShares {
  type: 'shares';
  /** Of all clouds together; 2 before this message. */
  cloud: number;
  /** By the video's number; 1 for those that are not listed, and before this message. */
  videos: number[];
}

/** Whether the operator wants to hear the robot's microphone. Before this message it does not. */
export interface Listen {
  type: 'listen';
  on: boolean;
}

/**
 * Whether the operator holds the key with which it speaks. While it does, it repeats the message, and sends its voice on
 * the m-line for sound.
 */
export interface Speak {
  type: 'speak';
  held: boolean;
}

/** The result of a latency test, for the robot's recording. */
export interface LatencyMeasured {
  type: 'latencyMeasured';
  /** The `id` from the command's {@link LatencyFrame}, and the frame that was drawn. */
  id: number;
  frameNumber: number;
  /**
   * From the input event to the end of the display frame that shows the whole green cloud, and to the one that shows
   * its first points, ms.
   */
  mtpMs: number;
  firstMs: number;
}

export type OperatorSessionMessage =
  | LeaseRequest
  | LeaseRelease
  | EstopRequest
  | StreamRequest
  | CloudFormats
  | Pictures
  | WantedSensors
  | WantedVideos
  | LinkShares
  | Listen
  | Speak
  | LatencyMeasured;

export const PROTOCOL_VERSION = 1;
