import { ReplayWindow } from '../dtls/replay-window.ts';

const SSRC_AT = 4;
/** Behind the tag: a flag, and the number of the packet (RFC 7714 §9.2). */
const INDEX_BYTES = 4;
const MIN_BYTES = 8 + 16 + INDEX_BYTES;
/** Senders of a peer: one for each of its streams, or one for all. */
const MAX_SENDERS = 64;

/**
 * Which SRTCP packets under AES-GCM were received before (RFC 3711 §3.3.2). werift does not look: whoever has seen one
 * could send it again and again, and use up what the peer may say.
 */
export class ReplayedRtcp {
  readonly #windows = new Map<number, ReplayWindow>();

  /** Call before deciphering a packet; call {@link mark} once it has proved authentic. */
  has(sealed: Buffer): boolean {
    if (sealed.length < MIN_BYTES) return false;
    return this.#windows.get(sealed.readUInt32BE(SSRC_AT))?.has(indexOf(sealed)) === true;
  }

  mark(sealed: Buffer): void {
    if (sealed.length < MIN_BYTES) return;
    const ssrc = sealed.readUInt32BE(SSRC_AT);
    let window = this.#windows.get(ssrc);
    if (window === undefined) {
      window = new ReplayWindow();
      this.#windows.set(ssrc, window);
      if (this.#windows.size > MAX_SENDERS) this.#windows.delete(this.#windows.keys().next().value as number);
    }
    window.mark(indexOf(sealed));
  }
}

function indexOf(sealed: Buffer): number {
  return sealed.readUInt32BE(sealed.length - INDEX_BYTES) & 0x7fffffff;
}
