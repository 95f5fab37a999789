/** Decodes a packet's data into the GPU's layout. One class per format; the worker chooses by the placement. */
import type { Placement, PointPacketHeader } from '@farpoint/protocol';
import type { Batch } from './batch.ts';
import type { DropReason } from './packet-intake.ts';

/** Where decoders put points. */
export interface BatchWriter {
  /** The batch being filled. It has room for `wanted` points, or is empty. `null`: all buffers are in use. */
  batchFor(wanted: number): Batch | null;
  /** Only one of this many points of a coded frame is handed on. */
  readonly every: number;
  /** The same for `points64`, which is already a sample. Changes only between batches. */
  readonly everySample: number;
  /** Whether clouds on a camera's grid are handed on as tiles of a surface, from their next frame on. */
  readonly surface: boolean;
  /** Counts a packet that yields no points. */
  drop(reason: DropReason): void;
}

export interface PacketDecoder {
  /**
   * Decodes one packet and adds its points to the writer's batch, at once or with the next one.
   *
   * @param data the codec's own bytes, without header and placement; they must not be modified later
   * @param receivedAtMs ms since the epoch
   */
  add(
    header: PointPacketHeader,
    placement: Placement,
    data: Uint8Array,
    receivedAtMs: number,
    writer: BatchWriter,
  ): void;
  /** Decodes a packet that waits for the next, which may be missing or too late for the batch. */
  settle(writer: BatchWriter): void;
  /** The batch is about to be handed over: writes whatever is not in it yet. */
  finish(batch: Batch): void;
  /** The batch will not be handed over. */
  abandon(): void;
}
