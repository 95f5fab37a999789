/**
 * Collects packet arrival times, by transport-wide sequence number, until they are reported to the sender. Uses fixed
 * memory.
 */
import { SequenceNumber, SequenceUnwrapper } from './sequence-number.ts';
import { writeTransportFeedback } from './transport-feedback-writer.ts';

/** Packets that are remembered until they are reported: a power of two. Chosen: 0.8 s of 10,000 a second. */
const CAPACITY = 8192;
/** One message fits into a datagram, whatever the arrivals. */
const MAX_PACKETS = 400;
/** Arrivals further apart go into separate messages, µs. */
const MAX_SPAN_US = 4_000_000;

export class ArrivalFeedback {
  readonly #arrivalsUs = new Float64Array(CAPACITY).fill(Number.NaN);
  readonly #unwrapper = new SequenceUnwrapper();
  /** The next sequence number that was not reported yet; the newest that arrived. */
  #next: number | null = null;
  #newest = -1;
  #count = 0;

  /**
   * @param sequence 16 bits
   * @param nowMs receiver's clock
   */
  add(sequence: number, nowMs: number): void {
    const index = this.#unwrapper.unwrap(sequence);
    if (this.#next === null) this.#next = index;
    // Already reported as lost, which cannot be taken back.
    if (index < this.#next) return;
    if (index - this.#next >= CAPACITY) this.#skipTo(index - CAPACITY + 1);
    this.#arrivalsUs[index % CAPACITY] = nowMs * 1000;
    this.#newest = Math.max(this.#newest, index);
  }

  /** One message about all or some of the arrivals; `null` if there is nothing to report. Call again until `null`. */
  take(senderSsrc: number, mediaSsrc: number): Uint8Array | null {
    if (this.#next === null) return null;
    while (this.#next <= this.#newest && Number.isNaN(this.#at(this.#next)) && this.#isFarBehind())
      this.#next++;
    const base = this.#next;
    const arrivalsUs: number[] = [];
    let firstUs = Number.NaN;
    let last = -1;
    for (let index = base; index <= this.#newest && arrivalsUs.length < MAX_PACKETS; index++) {
      const arrivalUs = this.#at(index);
      if (!Number.isNaN(arrivalUs)) {
        if (Number.isNaN(firstUs)) firstUs = arrivalUs;
        if (Math.abs(arrivalUs - firstUs) > MAX_SPAN_US) break;
        last = arrivalsUs.length;
      }
      arrivalsUs.push(arrivalUs);
    }
    if (last < 0) return null;
    arrivalsUs.length = last + 1;
    for (let index = base; index <= base + last; index++) this.#arrivalsUs[index % CAPACITY] = Number.NaN;
    this.#next = base + last + 1;
    const feedbackCount = this.#count++ & 0xff;
    return writeTransportFeedback({
      senderSsrc,
      mediaSsrc,
      baseSequence: SequenceNumber.of(base),
      feedbackCount,
      arrivalsUs,
    });
  }

  /** Whether the gap up to the next packet that arrived is longer than one message can report. */
  #isFarBehind(): boolean {
    return this.#newest - (this.#next as number) >= MAX_PACKETS;
  }

  #at(index: number): number {
    return this.#arrivalsUs[index % CAPACITY] as number;
  }

  #skipTo(index: number): void {
    for (let i = this.#next as number; i < index && i <= this.#newest; i++)
      this.#arrivalsUs[i % CAPACITY] = Number.NaN;
    this.#next = index;
  }
}
