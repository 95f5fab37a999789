import { BitRate } from '@farpoint/timing';

/** Traffic that shares the link with the peers, made by the model itself. */
export interface CrossFlow {
  /** When it next wants to do something; Infinity for never. */
  readonly nextMs: number;
  /** Does what is due; `send` offers one packet to the link and says whether the link took it. */
  run(nowMs: number, send: (handle: number, wireBytes: number) => boolean): void;
  /** One of its packets came out at the far end. */
  delivered(handle: number, atMs: number): void;
}

/** Constant bit rate: one packet after the other, whatever becomes of them. */
export class CbrFlow implements CrossFlow {
  readonly #intervalMs: number;
  readonly #wireBytes: number;
  nextMs: number;

  /** @param mbps 10^6 bit/s on the wire */
  constructor(mbps: number, startMs: number, wireBytes = 1250) {
    if (!(mbps > 0 && Number.isFinite(mbps))) throw new RangeError(`a flow of ${mbps} Mbit/s cannot be`);
    this.#wireBytes = wireBytes;
    this.#intervalMs = BitRate.msFor(BitRate.fromMbps(mbps), wireBytes);
    this.nextMs = startMs;
  }

  run(_nowMs: number, send: (handle: number, wireBytes: number) => boolean): void {
    send(0, this.#wireBytes);
    this.nextMs += this.#intervalMs;
  }

  delivered(): void {}
}
