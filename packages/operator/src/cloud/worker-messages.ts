/** Messages between the page and the cloud worker. */
import type { CloudStream } from '@farpoint/protocol';
import type { DropCounts } from './packet-intake.ts';

export type ToCloudWorker =
  /** A buffer of an earlier batch, for reuse. */
  | { type: 'return'; buffer: ArrayBuffer }
  /** Take frames from a bridge's streaming socket; a new generation means another robot. */
  | { type: 'bridge'; url: string; generation: number }
  /** In browsers without `RTCRtpScriptTransform`: the receiver's stream of encoded frames. */
  | { type: 'stream'; readable: ReadableStream<RTCEncodedAudioFrame>; generation: number }
  /** The header with which a format's packets are decoded from now on. */
  | {
      type: 'cloudStream';
      generation: number;
      sensor: number;
      format: CloudStream['format'];
      header: Uint8Array;
    }
  /** Hand on only one of this many points, of coded frames and of `points64`: the machine draws too slowly for more. */
  | { type: 'drawEvery'; every: number; everySample: number }
  /** Hand on clouds on a camera's grid as tiles of a surface, or as points. */
  | { type: 'drawSurface'; wanted: boolean };

/** Options of the `RTCRtpScriptTransform`. */
export interface CloudTransformOptions {
  /** Number of the session, by which batches of an earlier one are recognised. */
  generation: number;
}

export type FromCloudWorker =
  | { type: 'ready' }
  | { type: 'failed'; message: string }
  /** A coded stream cannot be decoded here. */
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

/** Totals since the session began. */
export interface IntakeReport {
  /** Number of the session, as in the `session` event. */
  generation: number;
  /** Packets that arrived, including dropped ones. */
  packetsReceived: number;
  /** Bytes of their RTP payloads. */
  bytesReceived: number;
  /** Packets missing in the RTP sequence, not counting those that came late. */
  packetsLost: number;
  /** Packets that arrived and were not decoded, by reason. */
  drops: DropCounts;
  /** Mean time that the worker spent on a packet since the last report, µs. */
  decodeUs: number;
}
