/** Messages between a robot's threads and the one that writes its recording. Times are ms on the robot's clock. */
import type { CloudFormat, PictureFormat, Pose, Twist } from '@farpoint/protocol';

export interface RecorderOptions {
  /** The MCAP file to write; it must not exist yet. */
  path: string;
  /** Compression of the file's chunks. */
  compression: 'none' | 'zstd';
  /** Maximum size, bytes: the file is completed before it exceeds it. Default: no limit. */
  mostBytes?: number | undefined;
  /** Zero of the robot's clock, ns since 1970. */
  epochNs: bigint;
  /** The robot's id, for people who read the file. */
  robotId: string;
}

/** A depth camera's intrinsics, pixels. */
export interface Lens {
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

interface RecordedStamp {
  capturedAtMs: number;
  /** Pose of the optical frame in the world. */
  pose: Pose;
  /** Numbers all clouds of the kind: a gap means that clouds were dropped. */
  sequence: number;
  /** How many of its kind have been dropped so far. */
  dropped: number;
  /** Transferred; returned with the answer. */
  buffer: ArrayBuffer;
}

/** A cloud as the source captured it. */
export type CapturedRecord = RecordedStamp &
  (
    | { type: 'points'; count: number; width: number; height: number }
    /** Depth (float32, metres), then colours (R, G, B, A), of each pixel. */
    | { type: 'images'; lens: Lens; width: number; height: number }
  );

/** A cloud as it was sent: packets in slots, each with its payload's length in its last two bytes. */
export type SentRecord = RecordedStamp & {
  type: 'sent';
  format: CloudFormat;
  points: number;
  packets: number;
  slotBytes: number;
  /** The stream header with which the packets of a coded format are decoded; `null` for `points64`. */
  streamHeader: Uint8Array | null;
};

export type CloudRecord = CapturedRecord | SentRecord;
export type CloudKind = 'captured' | 'sent';

/** A camera whose pictures are recorded. */
export interface RecordedCamera {
  /** The name that people read. */
  name: string;
  /** Whether the clouds come from this camera. */
  ofCloud: boolean;
}

/** A camera's picture as sent to operators: a JPEG or PNG file. */
export interface PictureRecord {
  type: 'picture';
  /** Index in the list of cameras. */
  camera: number;
  capturedAtMs: number;
  /** Numbers all pictures of the camera: a gap means that pictures were dropped. */
  sequence: number;
  /** How many pictures of all cameras have been dropped so far. */
  dropped: number;
  format: PictureFormat;
  /** Transferred. */
  file: Uint8Array<ArrayBuffer>;
}

/** The kinds of records that are dropped if the writer cannot keep up. Each kind has its own queue. */
export type DropKind = CloudKind | 'pictures' | 'events';

/** Returns a cloud's memory. */
export interface CloudDone {
  kind: CloudKind;
  buffer: ArrayBuffer;
  /** The file is full: no more clouds are written. */
  ended: boolean;
}

/** Topics of the messages that are written as JSON. */
export const JSON_TOPICS = {
  command: '/farpoint/commands',
  telemetry: '/farpoint/telemetry',
  estimate: '/farpoint/estimates',
  latency: '/farpoint/latencies',
  motionToPhoton: '/farpoint/motion_to_photon',
  recorder: '/farpoint/recorder',
} as const;
export type JsonKind = keyof typeof JSON_TOPICS;

export type EventRecord =
  | { type: 'json'; kind: JsonKind; timeMs: number; sequence: number; value: object }
  /** The velocity that was sent to the wheels. */
  | { type: 'velocity'; timeMs: number; sequence: number; twist: Twist }
  /** Pose of base_link in the world, and its velocity. */
  | { type: 'state'; timeMs: number; sequence: number; pose: Pose; twist: Twist };

export type RecorderRequest =
  | EventRecord
  | PictureRecord
  /** Sent before the first picture. */
  | { type: 'cameras'; cameras: readonly RecordedCamera[] }
  | { type: 'close' };

export type RecorderReport =
  | { type: 'ready' }
  /** An event or a picture has been processed. */
  | { type: 'done'; kind: 'events' | 'pictures' }
  /** The file has reached its maximum size and is closed. */
  | { type: 'full' }
  /** Writing failed: nothing more is written. */
  | { type: 'failed'; detail: string }
  | {
      type: 'written';
      messages: number;
      bytes: number;
      faults: number;
      dropped: Readonly<Record<CloudKind, number>>;
    }
  | { type: 'closed' };
