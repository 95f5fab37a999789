/** Where clouds come from. A source lives in the capture worker; its times are the robot's clock, ms. */
import type { Pose } from '@farpoint/protocol';
import type { TopicEntry, TopicReading } from '@farpoint/ros';
import type { Pinhole } from '@farpoint/wasm-codec';
import type { BaseState } from '../base/base.ts';
import type { PictureTaker } from '../pictures/source-picture.ts';

/** A camera whose pictures can be shown. */
export interface CameraDescription {
  /** What people read. */
  name: string;
  /** Most pictures a second that are to be looked at; `null`: as many as come. */
  most: number | null;
  /** It is the one that the clouds come from. */
  ofCloud?: true;
}

/** Of a camera's name. */
const MOST_NAME = 64;

/** The camera whose pictures a topic has, as people read it; of a long topic, its end. */
export function cameraOf({ topic, label, most }: TopicEntry): CameraDescription {
  return { name: (label ?? topic).slice(-MOST_NAME), most };
}

export interface SourceDescription {
  /** What it is, for people, e.g. `sim`. */
  kind: string;
  /** The grid of its clouds; height 1 where they have none. */
  width: number;
  height: number;
  /** Most points of a frame. */
  capacity: number;
  /** The camera of frames that come as images, `null` where they come as points. */
  camera: Pinhole | null;
  /** What the sampler takes as depth: `range` for sensors that look all around. */
  depthMeasure: 'z' | 'range';
  /** What it gives at most, frames a second, where it says so itself. */
  framesPerSecond?: number;
  /** Cameras whose pictures it can give, beside its clouds. */
  cameras?: readonly CameraDescription[];
}

/** What a source that makes its clouds to measure is told. */
export interface CaptureWishes {
  /** The rate that clouds should fit, bit/s. */
  bitsPerSecond: number;
  /** Make the next cloud green. */
  latencyTest: boolean;
}

/** Where a source may put its cloud, to spare a copy: the encoder's own memory, good until the next cloud. */
export interface CaptureRoom {
  /** As in {@link PointFrame}, for as many points as the description's capacity. */
  points: Float32Array;
  /** As in {@link ImageFrame}; empty without a camera. */
  depth: Float32Array;
  colour: Uint32Array;
}

/** What every cloud carries. */
interface FrameStamp {
  /** The optical frame in the world. */
  cameraPose: Pose;
  capturedAtMs: number;
  /** Whether this is the cloud that answers a latency test; left out, any may be. */
  latencyTest?: boolean;
}

/** A cloud as points. They are a view that the next capture may overwrite. */
export interface PointFrame extends FrameStamp {
  form: 'points';
  /** x, y, z in metres in the optical frame; the fourth word's bytes are R, G, B, A. */
  points: Float32Array;
  /** How many are filled. */
  count: number;
}

/** A cloud as a depth camera's pictures, of the size and camera that the description says. Views, as above. */
export interface ImageFrame extends FrameStamp {
  form: 'images';
  /** Along z, metres; not valid: 0, negative, NaN or infinite. */
  depth: Float32Array;
  /** R, G, B, A of each pixel, R lowest. */
  colour: Uint32Array;
}

export type SourceFrame = PointFrame | ImageFrame;

export interface FrameSource {
  readonly description: SourceDescription;
  /** Called once, when somebody listens to what it tells. */
  start?(): void;
  /**
   * Takes one cloud now; `null` where there is none.
   *
   * @throws {Error} where the source is broken for good
   */
  capture(nowMs: number, wishes: CaptureWishes, room: CaptureRoom): SourceFrame | null;
  /**
   * Of a source with a rhythm of its own: called at each new cloud. It is called again once that was taken or let go.
   * Where there is no such member, the worker asks at its own rhythm.
   */
  onReady?: (() => void) | null;
  /** Lets the cloud go that is ready. */
  skip?(nowMs: number, wishes: CaptureWishes): void;
  /** Called for what may pass: a producer that is gone, a cloud that cannot be read. */
  onFault?: ((error: Error) => void) | null;
  /** Called for what else the robot's topics say, for people. */
  onReading?: ((reading: TopicReading) => void) | null;
  /** Where pictures go from now on. */
  usePictures?(taker: PictureTaker): void;
  /** Which cameras are watched, pictures a second; 0: nobody looks. */
  watchPictures?(perSecond: readonly number[]): void;
  /** What it knows of the base that carries it. */
  readonly state: BaseState;
  close(): void;
}
