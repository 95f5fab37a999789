import type { VoiceState } from '@farpoint/protocol';

/**
 * Without a packet for so long, the voice is closed, ms. Ten packets of 20 ms: losses in a row are shorter.
 * docs/sound.md promises it, robot-sound.test.ts holds it.
 */
const VOICE_SILENCE_MS = 200;
/**
 * An operator that has not said for so long that it holds the key does not hold it, ms. Chosen: several of
 * the page's repetitions, and no longer than a word that nobody wants to be heard.
 */
const HOLD_MS = 1000;

/**
 * Whether an operator's voice is played: only that of the operator who drives, only while it holds the key and its
 * packets arrive. Time is an argument, ms.
 */
export class VoiceGate {
  /** When the operator last said that it holds the key. */
  #heldMs = Number.NEGATIVE_INFINITY;
  /** When it began to. */
  #sinceMs = Number.NEGATIVE_INFINITY;
  /** When a packet was last played. */
  #packetMs = Number.NEGATIVE_INFINITY;

  /** The operator says whether it holds the key. */
  hold(held: boolean, nowMs: number): void {
    if (!held) this.close();
    else {
      if (!this.isHeld(nowMs)) this.#sinceMs = nowMs;
      this.#heldMs = nowMs;
    }
  }

  /** Whatever the operator has said no longer holds. */
  close(): void {
    this.#heldMs = Number.NEGATIVE_INFINITY;
    this.#packetMs = Number.NEGATIVE_INFINITY;
  }

  /** A packet has come. @returns whether to play it */
  packet(drives: boolean, nowMs: number): boolean {
    if (!drives || !this.isHeld(nowMs)) return false;
    const closedMs = Math.max(this.#packetMs, this.#sinceMs) + VOICE_SILENCE_MS;
    // After a silence, the operator must have said again that it holds the key.
    if (nowMs > closedMs && this.#packetMs !== Number.NEGATIVE_INFINITY && this.#heldMs <= closedMs)
      return false;
    this.#packetMs = nowMs;
    return true;
  }

  /** Whether the operator holds the key, as far as it has said. */
  isHeld(nowMs: number): boolean {
    return nowMs - this.#heldMs <= HOLD_MS;
  }

  state(drives: boolean, nowMs: number): Exclude<VoiceState, 'failed'> {
    if (!this.isHeld(nowMs)) return 'closed';
    if (!drives) return 'not-driving';
    if (nowMs - this.#packetMs <= VOICE_SILENCE_MS) return 'open';
    return nowMs - this.#sinceMs <= VOICE_SILENCE_MS ? 'closed' : 'silent';
  }
}
