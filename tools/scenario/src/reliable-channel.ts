import type { Direction } from './direction.ts';

/** Where packets go. */
export type Way = Pick<Direction, 'send'>;

/** A packet without an answer goes again after this time, ms: twice, and so on. */
const REPEAT_MS = 200;
const MOST_REPEAT_MS = 3200;
const HEADER_BYTES = 60;

/** Messages in order and without loss over a direction that loses them, as an SCTP stream carries them. */
export class ReliableChannel {
  readonly #there: Way;
  readonly #back: Way;
  readonly #deliver: (text: string) => void;
  readonly #open: () => boolean;
  readonly #early = new Map<number, string>();
  #sent = 0;
  #delivered = 0;

  /**
   * @param back carries the acknowledgements
   * @param open whether the connection is: after its end nothing is sent or delivered
   */
  constructor(there: Way, back: Way, deliver: (text: string) => void, open: () => boolean) {
    this.#there = there;
    this.#back = back;
    this.#deliver = deliver;
    this.#open = open;
  }

  send(text: string): void {
    const packet = { number: this.#sent++, text, acknowledged: false };
    this.#transmit(packet, REPEAT_MS);
  }

  #transmit(packet: { number: number; text: string; acknowledged: boolean }, repeatMs: number): void {
    if (packet.acknowledged || !this.#open()) return;
    this.#there.send(HEADER_BYTES + packet.text.length, () => {
      if (!this.#open()) return;
      this.#back.send(HEADER_BYTES, () => {
        packet.acknowledged = true;
      });
      this.#arrive(packet.number, packet.text);
    });
    setTimeout(() => this.#transmit(packet, Math.min(2 * repeatMs, MOST_REPEAT_MS)), repeatMs);
  }

  #arrive(number: number, text: string): void {
    if (number < this.#delivered) return;
    this.#early.set(number, text);
    for (;;) {
      const next = this.#early.get(this.#delivered);
      if (next === undefined) return;
      this.#early.delete(this.#delivered++);
      this.#deliver(next);
    }
  }
}
