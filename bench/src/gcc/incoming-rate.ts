import { BitRate } from '@farpoint/timing';

/** The window `T`, ms. On a fast path, the last MOST_PACKETS packets, which span less. */
const WINDOW_MS = 1000;
const MOST_PACKETS = 500;
/** Minimum number of packets for a rate. */
const LEAST_PACKETS = 10;

/**
 * The incoming rate, `R_hat` (draft-ietf-rmcat-gcc-02, section 5.5), over the latest packets. As in libwebrtc, the
 * longest gap does not count, because paths hold packets back and then release them at once. The result never exceeds
 * the sending rate of the same packets.
 */
export class IncomingRate {
  readonly #sent = new Float64Array(MOST_PACKETS);
  readonly #arrived = new Float64Array(MOST_PACKETS);
  readonly #bytes = new Float64Array(MOST_PACKETS);
  #first = 0;
  #end = 0;

  add(bytes: number, sentMs: number, arrivedMs: number): void {
    if (this.#end - this.#first === MOST_PACKETS) this.#first++;
    const at = this.#end++ % MOST_PACKETS;
    this.#sent[at] = sentMs;
    this.#arrived[at] = arrivedMs;
    this.#bytes[at] = bytes;
    while (arrivedMs - (this.#arrived[this.#first % MOST_PACKETS] as number) > WINDOW_MS) this.#first++;
  }

  /** Bit/s; NaN while too few packets have arrived. */
  get bitsPerSecond(): number {
    if (this.#end - this.#first < LEAST_PACKETS) return Number.NaN;
    let bytes = 0;
    // The first packet arrived before the measured time span.
    for (let i = this.#first + 1; i < this.#end; i++) bytes += this.#bytes[i % MOST_PACKETS] as number;
    const elapsedMs = Math.max(this.#spanMs(this.#sent), this.#spanMs(this.#arrived));
    return elapsedMs > 0 ? BitRate.of(bytes, elapsedMs) : Number.NaN;
  }

  reset(): void {
    this.#first = this.#end;
  }

  /** From first to last packet, minus the longest gap. */
  #spanMs(times: Float64Array): number {
    let span = 0;
    let longest = 0;
    let newest = times[this.#first % MOST_PACKETS] as number;
    for (let i = this.#first + 1; i < this.#end; i++) {
      const gap = Math.max((times[i % MOST_PACKETS] as number) - newest, 0);
      newest += gap;
      span += gap;
      longest = Math.max(longest, gap);
    }
    return span - longest;
  }
}
