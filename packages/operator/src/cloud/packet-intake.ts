/** Checks each received payload, counts what is dropped and why, and finds gaps in the RTP sequence. */
import {
  type CloudPayloadFault,
  emptyPlacement,
  emptyPointPacketHeader,
  type Placement,
  type PointPacketHeader,
  readCloudPayload,
} from '@farpoint/protocol';
import { SequenceNumber, SequenceUnwrapper } from '@farpoint/rtp';
import type { PacketFault, UnorganisedFault } from '@farpoint/wasm-codec';

/** Why a packet is not drawn. The first reasons are those of the wire format and its codecs. */
export type DropReason =
  | CloudPayloadFault
  | PacketFault
  | UnorganisedFault
  /** The packet has a coded format whose stream header has not arrived. */
  | 'no-stream'
  /** Decoded, but the number of points differs from the header's. */
  | 'bad-count'
  /** Packets arrive faster than they are decoded, and this one waited too long. */
  | 'decoder-behind'
  /** The page has not returned buffers: it draws too slowly. */
  | 'no-buffer'
  /** Handed to the page, but newer points came before it was drawn. */
  | 'page-behind'
  /** Its frame had already been replaced on the screen. */
  | 'late'
  /** Its place in the picture had already been replaced. */
  | 'superseded'
  /** More fragments than can be drawn at once. */
  | 'window-full';

/** How many packets were dropped, by reason; a reason that never occurred is absent. */
export type DropCounts = Partial<Record<DropReason, number>>;

export function countDrop(counts: DropCounts, reason: DropReason, by = 1): void {
  counts[reason] = (counts[reason] ?? 0) + by;
}

export class PacketIntake {
  /** The header of the last payload that {@link take} accepted; the next one overwrites it. */
  readonly header: PointPacketHeader = emptyPointPacketHeader();
  readonly placement: Placement = emptyPlacement();
  readonly drops: DropCounts = {};
  readonly #sequence = new SequenceUnwrapper();
  #firstSequence: number | null = null;
  #highestSequence = 0;
  #numberedPackets = 0;
  packetsReceived = 0;
  bytesReceived = 0;

  /** Packets missing between the first and the highest sequence number, not counting those that came late. */
  get packetsLost(): number {
    if (this.#firstSequence === null) return 0;
    // A duplicate can fill a gap in this sum, as in RFC 3550 A.3.
    return Math.max(0, this.#highestSequence - this.#firstSequence + 1 - this.#numberedPackets);
  }

  /**
   * Counts the packet and reads it into {@link header} and {@link placement}.
   *
   * @param rtpSequence 16 bits; absent if the browser does not provide it
   * @returns why it is dropped, or `null`
   */
  take(payload: DataView, rtpSequence: number | undefined): CloudPayloadFault | null {
    this.packetsReceived++;
    this.bytesReceived += payload.byteLength;
    if (rtpSequence !== undefined) this.#follow(rtpSequence);
    const fault = readCloudPayload(payload, this.header, this.placement);
    if (fault !== null) countDrop(this.drops, fault);
    return fault;
  }

  #follow(rtpSequence: number): void {
    const sequence = this.#sequence.unwrap(SequenceNumber.of(rtpSequence));
    this.#numberedPackets++;
    if (this.#firstSequence === null) {
      this.#firstSequence = sequence;
      this.#highestSequence = sequence;
    } else {
      this.#firstSequence = Math.min(this.#firstSequence, sequence);
      this.#highestSequence = Math.max(this.#highestSequence, sequence);
    }
  }
}
