/** Collects when packets came, by transport-wide sequence number, until they are told to the sender. Fixed memory. */
import { SequenceNumber, SequenceUnwrapper } from './sequence-number.ts';
import { writeTransportFeedback } from './transport-feedback-writer.ts';

const CAPACITY = 8192;
/** One message fits into a datagram, whatever the arrivals. */
const MAX_PACKETS = 400;
/** Arrivals further apart go into messages of their own, µs. */
const MAX_SPAN_US = 4_000_000;

export class ArrivalFeedback {
  readonly #arrivalsUs = new Float64Array(CAPACITY).fill(Number.NaN);
  readonly #unwrapper = new SequenceUnwrapper();
  /** The next that nothing was said of; the newest that came. */
  #next: number | null = null;
  #newest = -1;
  #count = 0;

  /** @param sequence 16 bits @param nowMs receiver's clock */
  add(sequence: number, nowMs: number): void {
    const index = this.#unwrapper.unwrap(sequence);
    if (this.#next === null) this.#next = index;
    // Spoken of already, as lost: that cannot be taken back.
    if (index < this.#next) return;
    if (index - this.#next >= CAPACITY) this.#skipTo(index - CAPACITY + 1);
    this.#arrivalsUs[index % CAPACITY] = nowMs * 1000;
    this.#newest = Math.max(this.#newest, index);
  }

  /** One message about all or some of what came, or `null` where nothing did: ask again until then. */
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

  /** Whether more lies before the next that came than one message can say. */
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
