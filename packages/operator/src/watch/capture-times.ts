/** When the frames of one video were captured, by the RTP timestamps that a relay has given them. */
const FRAMES_KEPT = 128;

export class CaptureTimes {
  readonly #captureMs = new Map<number, number>();

  /** @param captureMs on the robot's clock */
  note(rtpTimestamp: number, captureMs: number): void {
    // A timestamp that comes again counts as new.
    this.#captureMs.delete(rtpTimestamp);
    this.#captureMs.set(rtpTimestamp, captureMs);
    if (this.#captureMs.size <= FRAMES_KEPT) return;
    const [oldest] = this.#captureMs.keys();
    if (oldest !== undefined) this.#captureMs.delete(oldest);
  }

  /** @returns ms on the robot's clock; `null` for a frame that said nothing, or that came long ago */
  of(rtpTimestamp: number): number | null {
    return this.#captureMs.get(rtpTimestamp) ?? null;
  }
}
