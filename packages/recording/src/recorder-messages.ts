/** Messages from the threads of a recording robot to the thread that writes. Times are of the robot's clock, ms. */
import type { ConnectionRefusal, LiveCounts, LiveListenerOptions } from '@farpoint/foxglove';
import type {
  Alarm,
  CloudFormat,
  DiagnosticReport,
  PictureFormat,
  Pose,
  Quantity,
  Twist,
} from '@farpoint/protocol';
import type { Destinations } from './message-outputs.ts';

export interface RecorderOptions {
  /** The MCAP file to write, which must not exist yet; `null` for none. */
  path: string | null;
  /** Its chunks: uncompressed or compressed. */
  compression: 'none' | 'zstd';
  /** The file is closed, complete, before it exceeds this size; unlimited if absent. */
  mostBytes?: number | undefined;
  /** The time since 1970 at which the robot's clock was 0, ns. */
  epochNs: bigint;
  /** For people: what is recorded. */
  robotId: string;
  /** Serves the same messages to live viewers. */
  live?: LiveListenerOptions | undefined;
}

/** Intrinsics of a depth camera's lens, pixels. */
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
  /** Counts all clouds of its kind: a gap shows dropped ones. */
  sequence: number;
  /** How many of its kind were dropped so far. */
  dropped: number;
  /** The receivers that it is for. */
  to: Destinations;
  /** Transferred; it comes back with the answer. */
  buffer: ArrayBuffer;
}

/** A cloud as the source delivered it. */
export type CapturedRecord = RecordedStamp &
  (
    | { type: 'points'; count: number; width: number; height: number }
    /** For each pixel, depth (float32, metres), then colour (R, G, B, A). */
    | { type: 'images'; lens: Lens; width: number; height: number }
  );

/** A cloud as it was sent: packets in slots, each with its payload's length in the slot's last two bytes. */
export type SentRecord = RecordedStamp & {
  type: 'sent';
  format: CloudFormat;
  points: number;
  packets: number;
  slotBytes: number;
  /** The header needed to decode the packets of a coded format. */
  streamHeader: Uint8Array | null;
};

export type CloudRecord = CapturedRecord | SentRecord;
export type CloudKind = 'captured' | 'sent';

/** A camera whose pictures are recorded. */
export interface RecordedCamera {
  /** Name shown to people. */
  name: string;
  /** Whether the clouds come from this camera. */
  ofCloud: boolean;
}

/** A camera's picture as it is sent to operators: a JPEG or PNG file. */
export interface PictureRecord {
  type: 'picture';
  /** Position in the list of cameras. */
  camera: number;
  capturedAtMs: number;
  /** Counts all pictures of the camera: a gap shows dropped ones. */
  sequence: number;
  /** How many pictures of all cameras were dropped so far. */
  dropped: number;
  format: PictureFormat;
  /** Transferred. */
  file: Uint8Array<ArrayBuffer>;
}

/** How the pictures of a video are coded. `vp8` is none of Foxglove's formats; this robot's own playback reads it. */
export const VIDEO_FORMATS = ['h264', 'vp8'] as const;
export type VideoFormatName = (typeof VIDEO_FORMATS)[number];

/** A camera whose video is recorded. */
export interface RecordedVideo {
  /** Name shown to people. */
  name: string;
  /** What it is coded with as a rule: with each frame it may change. */
  format: VideoFormatName;
}

/** A camera's picture as it was coded for operators. H.264: an access unit as in Annex B. VP8: a frame. */
export interface VideoRecord {
  type: 'video';
  /** Position in the list of videos. */
  video: number;
  capturedAtMs: number;
  /** Whether it can be decoded without any other. */
  key: boolean;
  format: VideoFormatName;
  /** Counts all frames of the video: a gap shows dropped ones. */
  sequence: number;
  /** How many frames of all videos were dropped so far. */
  dropped: number;
  /** The receivers that it is for. */
  to: Destinations;
  /** Transferred. */
  bytes: Uint8Array<ArrayBuffer>;
}

/** What is dropped if the writer does not keep up; each kind has its own queue. */
export type DropKind = CloudKind | 'pictures' | 'videos' | 'events';

/** The clouds that have a receiver. */
export interface CloudWishes {
  /** The file takes clouds: not if it is full. */
  file: boolean;
  /** Kinds that live viewers subscribe to. */
  live: Readonly<Record<CloudKind, boolean>>;
}

/** To the capture thread: the wishes, and perhaps a cloud's memory for reuse. */
export interface CloudAnswer {
  wishes: CloudWishes;
  done: { kind: CloudKind; buffer: ArrayBuffer } | null;
}

/** What live viewers subscribe to, by how it is recorded. */
export interface LiveWishes {
  clouds: CloudWishes['live'];
  /** Positions of cameras. */
  pictures: readonly number[];
  videos: readonly number[];
  events: readonly EventKind[];
}

export const NO_LIVE_WISHES: LiveWishes = {
  clouds: { captured: false, sent: false },
  pictures: [],
  videos: [],
  events: [],
};

/** For `/metrics`. */
export type LiveReport = LiveCounts & { connectionsRefused: Readonly<Record<ConnectionRefusal, number>> };

/** Topics of what is written as JSON. */
export const JSON_TOPICS = {
  command: '/farpoint/commands',
  telemetry: '/farpoint/telemetry',
  estimate: '/farpoint/estimates',
  latency: '/farpoint/latencies',
  motionToPhoton: '/farpoint/motion_to_photon',
  audit: '/farpoint/audit',
  recorder: '/farpoint/recorder',
} as const;
export type JsonKind = keyof typeof JSON_TOPICS;

/** A quantity whose samples are recorded. */
export type RecordedQuantity = Pick<Quantity, 'topic' | 'field' | 'label' | 'unit'>;

/** An alarm whose changes are recorded. */
export interface RecordedAlarm {
  /** The quantity that it watches: of the robot's state, or a topic with a field. */
  watches: string;
  /** The quantity's name, for people. */
  label: string;
}

export type EventKind = JsonKind | 'velocity' | 'state' | 'bookmark' | TelemetryRecord['type'];

/** What the robot tells about itself besides its state. */
export type TelemetryRecord =
  /** @param quantity position in the list of quantities @param timeMs when it was measured */
  | { type: 'sample'; timeMs: number; sequence: number; quantity: number; value: number }
  /**
   * @param alarm position in the list of alarms
   * @param timeMs when it changed, or when it is repeated
   */
  | {
      type: 'alarm';
      timeMs: number;
      sequence: number;
      alarm: number;
      state: Pick<Alarm, 'level' | 'text' | 'value' | 'limit' | 'unit' | 'sinceMs'>;
    }
  /** The reports of all components of a topic. */
  | {
      type: 'diagnostics';
      timeMs: number;
      sequence: number;
      topic: string;
      reports: readonly DiagnosticReport[];
    };

export type EventRecord =
  | TelemetryRecord
  | { type: 'json'; kind: JsonKind; timeMs: number; sequence: number; value: object }
  /** The velocity that the wheels were given. */
  | { type: 'velocity'; timeMs: number; sequence: number; twist: Twist }
  /** An instant that somebody wants to find again. @param by who wants it @param text says which, for people */
  | { type: 'bookmark'; timeMs: number; sequence: number; by: string; text: string }
  /** Pose of base_link in the world. */
  | { type: 'state'; timeMs: number; sequence: number; pose: Pose; twist: Twist };

export type RecorderRequest =
  | EventRecord
  | PictureRecord
  | VideoRecord
  /** Sent before the first picture. */
  | { type: 'cameras'; cameras: readonly RecordedCamera[] }
  /** Sent before the first frame of a video. */
  | { type: 'videos'; videos: readonly RecordedVideo[] }
  /** Sent before the first sample or alarm. */
  | { type: 'telemetry'; quantities: readonly RecordedQuantity[]; alarms: readonly RecordedAlarm[] }
  /** Sent before the first reports of the topic's components. */
  | { type: 'components'; topic: string }
  /** Begins another file, which must not exist yet, if none is being written. */
  | { type: 'openFile'; path: string }
  /** Completes the file. */
  | { type: 'closeFile' }
  | { type: 'close' };

export type RecorderReport =
  /** @param port of the live server; `null` if there is none */
  | { type: 'ready'; live: { port: number } | { failed: string } | null }
  /** What live viewers want has changed. */
  | { type: 'wishes'; wishes: LiveWishes }
  /** A live viewer can go on with a key frame of this video only. */
  | { type: 'keyFrame'; video: number }
  | ({ type: 'live' } & LiveReport)
  /** An event, a picture or a frame of a video was processed. */
  | { type: 'done'; kind: 'events' | 'pictures' | 'videos' }
  /** Another file was begun, or could not be: then `failed` says why. */
  | { type: 'fileOpened'; path: string; failed: string | null }
  /** The file is complete. */
  | { type: 'fileClosed' }
  /** The file has reached its maximum size and is closed. */
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
