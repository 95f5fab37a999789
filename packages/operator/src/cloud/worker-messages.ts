/** What the page and the cloud worker say to each other. */
import type { CloudStream } from '@farpoint/protocol';
import type { DropCounts } from './packet-intake.ts';

export type ToCloudWorker =
  /** A buffer of an earlier batch, empty again. */
  | { type: 'return'; buffer: ArrayBuffer }
  /** Take frames from a bridge's streaming socket; another generation is another robot. */
  | { type: 'bridge'; url: string; generation: number }
  /** Where the browser lacks `RTCRtpScriptTransform`: the receiver's stream of encoded frames. */
  | { type: 'stream'; readable: ReadableStream<RTCEncodedAudioFrame>; generation: number }
  /** What packets of a coded format are decoded with from now on. */
  | {
      type: 'cloudStream';
      generation: number;
      sensor: number;
      format: CloudStream['format'];
      header: Uint8Array;
    }
  /** Only one of every so many points is handed on, of a coded frame and of `points64`: the machine draws too slowly for more. */
  | { type: 'drawEvery'; every: number; everySample: number };

/** Options of the `RTCRtpScriptTransform`. */
export interface CloudTransformOptions {
  /** Counts sessions: batches of an earlier one are told by it. */
  generation: number;
}

export type FromCloudWorker =
  | { type: 'ready' }
  | { type: 'failed'; message: string }
  /** A coded stream that cannot be decoded here. */
  | { type: 'streamRefused'; generation: number; format: CloudStream['format']; message: string }
  /** Points of one sensor. */
  | {
      type: 'batch';
      generation: number;
      sensor: number;
      packets: number;
      points: number;
      buffer: ArrayBuffer;
    }
  | ({ type: 'report' } & IntakeReport);

/** Sums since the session began. */
export interface IntakeReport {
  /** Counts sessions: the same as that of the `session` event. */
  generation: number;
  /** Packets that arrived, dropped ones included. */
  packetsReceived: number;
  /** Bytes of their RTP payloads. */
  bytesReceived: number;
  /** Packets missing in the RTP sequence, less those that came late. */
  packetsLost: number;
  /** Packets that arrived and were not decoded, by reason. */
  drops: DropCounts;
  /** Mean µs the worker spent on a packet since the last report. */
  decodeUs: number;
}
