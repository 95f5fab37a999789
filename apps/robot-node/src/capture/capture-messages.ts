/** What the main thread and the capture worker say to each other. */
import type { MessagePort } from 'node:worker_threads';
import type { Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import type { EncodedFrame, SamplingOptions } from '../encode/encoded-frame.ts';
import type { FrameAudience } from '../encode/frame-formats.ts';
import type { CodedFormat, PlanPolicy } from '../encode/plan.ts';
import type { CameraDescription, SourceDescription, SourceState } from './frame-source.ts';
import type { SourceOptions } from './open-source.ts';

export interface CaptureOptions {
  source: SourceOptions;
  /** The most the source may be asked for. */
  framesPerSecond: number;
  plan: PlanPolicy;
  sampling: Omit<SamplingOptions, 'depthMeasure'>;
  floorFraction: number;
  mostPoints: number;
  /** Also give the colour pictures of the camera that clouds come from, where it is one. */
  picturesOfCloud?: boolean;
  /** Without a word on the velocity for this long the worker itself stops the robot. */
  watchdogMs: number;
}

/** What the stream may take. */
export interface CaptureBudget {
  targetBitsPerSecond: number;
  /** Bytes that the transport adds to each payload. */
  overheadBytes: number;
  /** With nobody watching nothing is captured. */
  streaming: boolean;
  /**
   * The rate control wants to try the link: one frame, the next, is to have at least so many bytes on the wire. Each
   * `clusterId` is one such wish.
   */
  probe: { clusterId: number; bytes: number } | null;
  /** The coded formats that may be used, where they fit a frame: each is read by somebody who decides. */
  coded: readonly CodedBudget[];
}

/** What frames in one coded format may take. */
export interface CodedBudget {
  format: CodedFormat;
  /** Of those who decide and read it, bit/s. */
  targetBitsPerSecond: number;
  /** Beside them: what those may be sent who do not read it, as `points64`, bit/s; `null` where there are none. */
  plainBitsPerSecond: number | null;
}

/** Nobody watches. */
export const NO_BUDGET: CaptureBudget = {
  targetBitsPerSecond: 0,
  overheadBytes: 0,
  streaming: false,
  probe: null,
  coded: [],
};

export type CaptureRequest =
  /** The velocity from now on; repeated at least every watchdog time while it is not zero. */
  | { type: 'twist'; twist: Twist }
  | ({ type: 'budget' } & CaptureBudget)
  /** Make the next captured frame a latency-test frame. */
  | { type: 'latencyTest' }
  /** A frame's buffer, no longer needed. */
  | { type: 'recycle'; buffer: ArrayBuffer }
  /** Pictures go to this port from now on. */
  | { type: 'pictures'; port: MessagePort }
  | { type: 'close' };

/** One frame, ready to send; `buffer` is transferred. */
export interface CapturedFrame extends EncodedFrame {
  type: 'frame';
  audience: FrameAudience;
  /** Packets in slots of 1248 bytes. */
  buffer: ArrayBuffer;
  latencyTest: boolean;
  /** How long until the next one, as planned, ms. */
  intervalMs: number;
  /** Robot's clock when the cloud was taken, ms, and how long that took. */
  capturedAtMs: number;
  captureMs: number;
  /** Of that, the thread's own processor time. */
  captureCpuMs: number;
  /** Robot's clock when its packets were made, ms. */
  readyMs: number;
}

export type CaptureReport =
  | { type: 'ready'; description: SourceDescription; cameras: readonly CameraDescription[] }
  | CapturedFrame
  /** What receivers of the coded frames that follow need. */
  | { type: 'stream'; stream: CodedStream }
  /** The robot's state, and frames that found no free buffer so far. */
  | { type: 'state'; timeMs: number; state: SourceState; framesWithoutBuffer: number; watchdogStops: number }
  /** Something is wrong with the source that may pass. */
  | { type: 'fault'; detail: string }
  /** What a topic says, for people. */
  | { type: 'reading'; reading: TopicReading }
  | { type: 'closed' };
