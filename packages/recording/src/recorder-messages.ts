/** What the threads of a recorded robot say to the one that writes. Times are of the robot's clock, ms. */
import type { CloudFormat, PictureFormat, Pose, Twist } from '@farpoint/protocol';

export interface RecorderOptions {
  /** The MCAP file to write; there must be none yet. */
  path: string;
  /** Its chunks: as they are, or packed. */
  compression: 'none' | 'zstd';
  /** The file ends, whole, before it is larger; left out, it may be of any size. */
  mostBytes?: number | undefined;
  /** The time since 1970 at the robot's clock's 0, ns. */
  epochNs: bigint;
  /** For people: what is recorded. */
  robotId: string;
}

/** A depth camera's lens, pixels. */
export interface Lens {
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

interface RecordedStamp {
  capturedAtMs: number;
  /** The optical frame in the world. */
  pose: Pose;
  /** Counts all there were: a gap is what was dropped. */
  sequence: number;
  /** How many of its kind were, so far. */
  dropped: number;
  /** Transferred; it comes back with the answer. */
  buffer: ArrayBuffer;
}

/** A cloud as the source gave it. */
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
  /** What the packets of a coded format are decoded with. */
  streamHeader: Uint8Array | null;
};

export type CloudRecord = CapturedRecord | SentRecord;
export type CloudKind = 'captured' | 'sent';

/** A camera whose pictures are recorded. */
export interface RecordedCamera {
  /** What people read. */
  name: string;
  /** It is the one that the clouds come from. */
  ofCloud: boolean;
}

/** A camera's picture as operators are sent it: a JPEG or PNG file. */
export interface PictureRecord {
  type: 'picture';
  /** Place in the list of cameras. */
  camera: number;
  capturedAtMs: number;
  /** Counts all there were of the camera: a gap is what was dropped. */
  sequence: number;
  /** How many were, so far, of all cameras. */
  dropped: number;
  format: PictureFormat;
  /** Transferred. */
  file: Uint8Array<ArrayBuffer>;
}

/** What is dropped where the writer does not keep up, each kind with a queue of its own. */
export type DropKind = CloudKind | 'pictures' | 'events';

/** A cloud's memory, free again. */
export interface CloudDone {
  kind: CloudKind;
  buffer: ArrayBuffer;
  /** The file is full: no more clouds are written. */
  ended: boolean;
}

/** Topics of what is written as JSON. */
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
  /** The velocity that the wheels were given. */
  | { type: 'velocity'; timeMs: number; sequence: number; twist: Twist }
  /** base_link in the world. */
  | { type: 'state'; timeMs: number; sequence: number; pose: Pose; twist: Twist };

export type RecorderRequest =
  | EventRecord
  | PictureRecord
  /** Before the first picture. */
  | { type: 'cameras'; cameras: readonly RecordedCamera[] }
  | { type: 'close' };

export type RecorderReport =
  | { type: 'ready' }
  /** An event or a picture was taken. */
  | { type: 'done'; kind: 'events' | 'pictures' }
  /** The file has as many bytes as it may, and is closed. */
  | { type: 'full' }
  /** Nothing more is written. */
  | { type: 'failed'; detail: string }
  | {
      type: 'written';
      messages: number;
      bytes: number;
      faults: number;
      dropped: Readonly<Record<CloudKind, number>>;
    }
  | { type: 'closed' };
