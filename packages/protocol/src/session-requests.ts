/** What an operator sends on the `session` channel; what the robot sends on it is in session-messages.ts. */
import type { CloudFormat } from './cloud-format.ts';
import type { DriveRequest } from './handover.ts';
import type { Point } from './pointing.ts';
import type { CommandCall, CommandCancel } from './robot-command.ts';

/** Requests the lease. `take` asks to take over from another operator; the robot's policy decides. */
export interface LeaseRequest {
  type: 'leaseRequest';
  take: boolean;
}
export interface LeaseRelease {
  type: 'leaseRelease';
}
/** Latches or releases the emergency stop. Anyone may latch it; the robot decides who may release it. */
export interface EstopRequest {
  type: 'estop';
  latch: boolean;
  /** With `latch`: the number of the press, as in {@link EstopPress}. Without it, each message is a press of its own. */
  press?: number | undefined;
  /**
   * Of a release: the `latch` of the robot's {@link EstopState} that is to be released. The robot refuses to release a
   * newer one.
   */
  of?: number | undefined;
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

/**
 * What the operator's computer can draw, by its own measurement; more than that is of no use to it. Before this message it
 * draws all that comes.
 */
export interface DisplayCapacity {
  type: 'display';
  /** Clouds a second. */
  framesPerSecond: number;
  /** Points of each. */
  points: number;
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

/** Ends another operator's session. Only for supervisors. */
export interface EndSession {
  type: 'endSession';
  /** The operator's number in the robot's list. */
  operator: number;
  /** Also refuses the operator's grant at this robot from now on. */
  block: boolean;
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
  | DisplayCapacity
  | Listen
  | Speak
  | EndSession
  | DriveRequest
  | CommandCall
  | CommandCancel
  | Point
  | LatencyMeasured;
