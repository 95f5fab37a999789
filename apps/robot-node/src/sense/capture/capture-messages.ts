/** Messages between the main thread and the capture worker. */
import type { MessagePort } from 'node:worker_threads';
import type {
  CameraDescription,
  PlayedMessage,
  PlayedPicture,
  SourceDescription,
  TimedBaseState,
} from '@farpoint/cloud-source';
import type { TopicReading } from '@farpoint/ros';
import type { CaptureBudget } from '../encode/capture-budget.ts';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import type { EncodedFrame, SamplingOptions } from '../encode/encoded-frame.ts';
import type { FrameAudience } from '../encode/frame-formats.ts';
import type { PlanPolicy } from '../encode/plan.ts';
import type { SensorGuardOptions } from '../obstacles/sensor-guard.ts';
import type { SourceOptions } from '../sources/open-source.ts';

export interface CaptureOptions {
  /** The sensor's index on this robot. */
  sensor: number;
  source: SourceOptions;
  /** The highest frame rate that the source may be asked for. */
  framesPerSecond: number;
  plan: PlanPolicy;
  sampling: Omit<SamplingOptions, 'depthMeasure'>;
  floorFraction: number;
  mostPoints: number;
  /** Also offer the colour pictures of the camera that the clouds come from, if they come from one. */
  picturesOfCloud?: boolean;
  /** Judges every whole cloud for the obstacle guard. */
  guard?: SensorGuardOptions;
}

export type CaptureRequest =
  | ({ type: 'budget' } & CaptureBudget)
  /** Whether the obstacle guard needs clouds, even if nobody watches. */
  | { type: 'guard'; wanted: boolean }
  /** Make the next captured frame a latency-test frame. */
  | { type: 'latencyTest' }
  /** Returns a frame's buffer that is no longer needed. */
  | { type: 'recycle'; buffer: ArrayBuffer }
  /** Whether somebody watches a video that the source plays. */
  | { type: 'watchVideo'; video: number; watched: boolean }
  /** Sends pictures to this port from now on. */
  | { type: 'pictures'; port: MessagePort }
  | { type: 'close' };

/** A frame that is ready to send; `buffer` is transferred. */
export interface ReadyFrame extends EncodedFrame {
  type: 'frame';
  sensor: number;
  /** The highest bit rate that frames like this one could use, bit/s on the wire. */
  usefulBitsPerSecond: number;
  audience: FrameAudience;
  /** Packets in slots of 1248 bytes. */
  buffer: ArrayBuffer;
  latencyTest: boolean;
  /** Planned time until the next frame, ms. */
  intervalMs: number;
  /** When the cloud was taken, robot's clock, ms. */
  capturedAtMs: number;
  /** When the source had handed it over, before the guard has judged it, robot's clock, ms. */
  inMemoryMs: number;
  /** How long it took to get the cloud from the source, ms. */
  captureMs: number;
  /** The thread's own processor time within `captureMs`. */
  captureCpuMs: number;
  /** When the packets were ready, robot's clock, ms. */
  readyMs: number;
}

export type CaptureReport =
  | { type: 'ready'; description: SourceDescription; cameras: readonly CameraDescription[] }
  | ReadyFrame
  /** What receivers need before the coded frames that follow. */
  | { type: 'stream'; stream: CodedStream }
  /** The source's view of the base, and the number of frames dropped so far for lack of a free buffer. */
  | { type: 'state'; state: TimedBaseState; framesWithoutBuffer: number }
  /** A fault of the source that may be temporary. */
  | { type: 'fault'; detail: string }
  /** The rings of the source's LiDAR are known, or changed: elevations, radians, ascending. */
  | { type: 'rings'; elevations: readonly number[] }
  /** A topic's message as text for people. */
  | { type: 'reading'; reading: TopicReading }
  /** What a played recording tells about the robot. */
  | { type: 'telemetry'; message: PlayedMessage }
  /** A coded picture of a played video; its bytes are transferred. */
  | { type: 'video'; video: number; picture: PlayedPicture }
  | { type: 'closed' };

/** Where the capture thread sends its reports. Buffers in `transfer` change owner. */
export type ReportSink = (report: CaptureReport, transfer?: ArrayBuffer[]) => void;
