/** Where clouds come from. The robot calls a source in its capture thread. Its times are on the robot's clock, ms. */
import type { Pose } from '@farpoint/protocol';
import type { TopicEntry, TopicReading } from '@farpoint/ros';
import type { Pinhole } from '@farpoint/wasm-codec';
import type { BaseState } from './base-state.ts';
import type { PlayedMessage, PlayedTelemetry } from './played-telemetry.ts';
import type { PictureTaker } from './source-picture.ts';

export const RECORDED_CODINGS = ['h264', 'vp8'] as const;
export type RecordedCoding = (typeof RECORDED_CODINGS)[number];

/** A coded picture of a played video. */
export interface PlayedPicture {
  coding: RecordedCoding;
  /** H.264: an access unit as in Annex B; VP8: a frame. */
  bytes: Uint8Array<ArrayBuffer>;
  /** On the robot's clock, as if it were captured now, ms. */
  capturedAtMs: number;
}

/** A camera whose pictures can be shown to the operator. */
export interface CameraDescription {
  /** The name shown to people. */
  name: string;
  /** Highest useful number of pictures per second; `null`: no limit. */
  most: number | null;
  /** Set for the camera that the clouds come from. */
  ofCloud?: true;
}

/** Maximum length of a camera's name. */
const MOST_NAME = 64;

/** The camera of a topic, with a name for people. A long topic is cut to its end. */
export function cameraOf({ topic, label, most }: TopicEntry): CameraDescription {
  return { name: (label ?? topic).slice(-MOST_NAME), most };
}

/** What is configured about where a source's sensor sits: the one place that says it. */
export interface Mounted {
  /** Its optical frame in base_link; `null` or without it, nobody has said. */
  mount?: Pose | null;
}

export interface SourceDescription {
  /** The kind of source, for people, e.g. `sim`. */
  kind: string;
  /** The grid of its clouds; height 1 if they have none. */
  width: number;
  height: number;
  /** Maximum number of points in a frame. */
  capacity: number;
  /** The camera of frames that come as images; `null` for frames that come as points. */
  camera: Pinhole | null;
  /** What the sampler uses as depth: `range` for sensors that look in all directions. */
  depthMeasure: 'z' | 'range';
  /** The source's highest frame rate, frames/s, if it knows. */
  framesPerSecond?: number;
  /** Cameras whose pictures it offers besides its clouds. */
  cameras?: readonly CameraDescription[];
  /** Videos that it plays, by name. */
  videos?: readonly string[];
  /** What it plays about the robot. */
  telemetry?: PlayedTelemetry;
}

/** Requests to a source that can adapt its clouds. */
export interface CaptureWishes {
  /** The bit rate that clouds should fit, bit/s. */
  bitsPerSecond: number;
  /** Make the next cloud green. */
  latencyTest: boolean;
}

/** Where a source may put its cloud, to avoid a copy: the encoder's own memory, valid until the next cloud. */
export interface CaptureRoom {
  /** Laid out as in {@link PointFrame}, for as many points as the description's capacity. */
  points: Float32Array;
  /** Laid out as in {@link ImageFrame}; empty without a camera. */
  depth: Float32Array;
  colour: Uint32Array;
}

/** What every cloud carries. */
interface FrameStamp {
  /** Pose of the optical frame in the world. */
  cameraPose: Pose;
  /**
   * Pose of base_link in the world then. `unknown` if nobody knows it; `disputed` if those who say where the sensor sits
   * contradict each other. Without it, the sensor's pose and its mount tell it.
   */
  base?: Pose | 'unknown' | 'disputed';
  capturedAtMs: number;
  /** Whether this cloud answers a latency test. If undefined, any cloud may. */
  latencyTest?: boolean;
}

/** A cloud as points: a view that the next capture may overwrite. */
export interface PointFrame extends FrameStamp {
  form: 'points';
  /** x, y, z in metres in the optical frame; the fourth word's bytes are R, G, B, A. */
  points: Float32Array;
  /** Number of points filled in. */
  count: number;
}

/** A cloud as a depth camera's images, with the description's size and camera. Views, as in {@link PointFrame}. */
export interface ImageFrame extends FrameStamp {
  form: 'images';
  /** Depth along z, metres. Invalid pixels are 0, negative, NaN or infinite. */
  depth: Float32Array;
  /** R, G, B, A of each pixel, with R in the lowest byte. */
  colour: Uint32Array;
}

export type SourceFrame = PointFrame | ImageFrame;

export interface FrameSource {
  readonly description: SourceDescription;
  /** Called once, when the callbacks are set. */
  start?(): void;
  /**
   * Takes the current cloud; `null` if there is none.
   *
   * @throws {Error} if the source has failed permanently
   */
  capture(nowMs: number, wishes: CaptureWishes, room: CaptureRoom): SourceFrame | null;
  /**
   * For a source that sets its own frame rate: called at each new cloud, and not again until that cloud has been
   * taken or skipped. For a source without this member, the worker asks at its own rate.
   */
  onReady?: (() => void) | null;
  /** Discards the cloud that is ready. */
  skip?(nowMs: number, wishes: CaptureWishes): void;
  /** Called for faults that may be temporary: a missing producer, an unreadable cloud. */
  onFault?: ((error: Error) => void) | null;
  /** Called with readings of the robot's other topics, for people. */
  onReading?: ((reading: TopicReading) => void) | null;
  /** Sets the receiver of pictures. */
  usePictures?(taker: PictureTaker): void;
  /** How many pictures per second each camera should give; 0: nobody watches it. */
  watchPictures?(perSecond: readonly number[]): void;
  /** Elevations of the rings of its LiDAR, radians, ascending; `null` while they are not known. A new array at a change. */
  readonly rings?: readonly number[] | null;
  /** Somebody watches something else of it than its clouds: clouds that nobody takes are skipped, not kept. */
  readonly goesOn?: boolean;
  /** Called with what a recording tells about the robot, when it is due. */
  onTelemetry?: ((message: PlayedMessage) => void) | null;
  /** Called with the coded pictures of watched videos. Their memory belongs to the receiver. */
  onVideo?: ((video: number, picture: PlayedPicture) => void) | null;
  /** Whether somebody watches a video. It begins with its last key frame. */
  watchVideo?(video: number, watched: boolean): void;
  /** The source's view of the base that carries it. */
  readonly state: BaseState;
  close(): void;
}
