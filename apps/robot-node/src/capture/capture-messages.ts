/** What the main thread and the capture worker say to each other. */
import type { MessagePort } from 'node:worker_threads';
import type { TopicReading } from '@farpoint/ros';
import type { TimedBaseState } from '../base/base.ts';
import type { CaptureBudget } from '../encode/capture-budget.ts';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import type { EncodedFrame, SamplingOptions } from '../encode/encoded-frame.ts';
import type { FrameAudience } from '../encode/frame-formats.ts';
import type { PlanPolicy } from '../encode/plan.ts';
import type { CameraDescription, SourceDescription } from './frame-source.ts';
import type { SourceOptions } from './open-source.ts';

export interface CaptureOptions {
  /** Its number among the robot's sensors. */
  sensor: number;
  source: SourceOptions;
  /** The most the source may be asked for. */
  framesPerSecond: number;
  plan: PlanPolicy;
  sampling: Omit<SamplingOptions, 'depthMeasure'>;
  floorFraction: number;
  mostPoints: number;
  /** Also give the colour pictures of the camera that clouds come from, where it is one. */
  picturesOfCloud?: boolean;
}

export type CaptureRequest =
  | ({ type: 'budget' } & CaptureBudget)
  /** Make the next captured frame a latency-test frame. */
  | { type: 'latencyTest' }
  /** A frame's buffer, no longer needed. */
  | { type: 'recycle'; buffer: ArrayBuffer }
  /** Pictures go to this port from now on. */
  | { type: 'pictures'; port: MessagePort }
  | { type: 'close' };

/** One frame, ready to send; `buffer` is transferred. */
export interface ReadyFrame extends EncodedFrame {
  type: 'frame';
  sensor: number;
  /** What frames like it could use at most, bit/s on the wire. */
  usefulBitsPerSecond: number;
  audience: FrameAudience;
  /** Packets in slots of 1248 bytes. */
  buffer: ArrayBuffer;
  latencyTest: boolean;
  /** How long until the next one, as planned, ms. */
  intervalMs: number;
  /** Robot's clock when the cloud was taken, ms. */
  capturedAtMs: number;
  /** How long taking it from the source took, ms. */
  captureMs: number;
  /** Of that, the thread's own processor time. */
  captureCpuMs: number;
  /** Robot's clock when its packets were made, ms. */
  readyMs: number;
}

export type CaptureReport =
  | { type: 'ready'; description: SourceDescription; cameras: readonly CameraDescription[] }
  | ReadyFrame
  /** What receivers of the coded frames that follow need. */
  | { type: 'stream'; stream: CodedStream }
  /** What the source knows of the base, and frames that found no free buffer so far. */
  | { type: 'state'; state: TimedBaseState; framesWithoutBuffer: number }
  /** Something is wrong with the source that may pass. */
  | { type: 'fault'; detail: string }
  /** What a topic says, for people. */
  | { type: 'reading'; reading: TopicReading }
  | { type: 'closed' };

/** Where the capture thread's reports go; what is in `transfer` changes hands. */
export type ReportSink = (report: CaptureReport, transfer?: ArrayBuffer[]) => void;
