/** From a packet's data to points in the layout of the GPU. One class a format; the worker picks by the placement. */
import type { Placement, PointPacketHeader } from '@farpoint/protocol';
import type { Batch } from './batch.ts';
import type { DropReason } from './packet-intake.ts';

/** Where decoders put points. */
export interface BatchWriter {
  /** The batch being filled; with `wanted` points it has room for them, or is empty. `null`: all buffers are out. */
  batchFor(wanted: number): Batch | null;
  /** Of a coded frame only one of every so many points is handed on. */
  readonly every: number;
  /** The same of `points64`, which is a sample already. Changes between batches only. */
  readonly everySample: number;
  /** Counts a packet that gives no points. */
  drop(reason: DropReason): void;
}

export interface PacketDecoder {
  /**
   * Decodes one packet and adds its points to the writer's batch, at once or with the next one.
   *
   * @param data the codec's own bytes, without header and placement; they must stay as they are
   * @param receivedAtMs since the epoch
   */
  add(
    header: PointPacketHeader,
    placement: Placement,
    data: Uint8Array,
    receivedAtMs: number,
    writer: BatchWriter,
  ): void;
  /** Decodes what waits for a next one: none may come, or too late for the batch. */
  settle(writer: BatchWriter): void;
  /** The batch is about to be handed over: what is not yet in it must come now. */
  finish(batch: Batch): void;
  /** The batch will not be handed over. */
  abandon(): void;
}
