/** Why something that came from a socket was dropped. None of it reached werift, none of it changed anything. */
export type Refusal =
  | 'stun-unauthenticated' // a STUN request without a MESSAGE-INTEGRITY of our session (RFC 8445 §7.3)
  | 'unknown-source' // no connectivity check of our session has come from, or gone to, this address
  | 'dtls-malformed' // no DTLS record, or a handshake fragment that contradicts itself
  | 'dtls-plaintext' // epoch 0 where everything is encrypted, or an alert that nobody vouches for
  | 'dtls-epoch' // an epoch that this session has no keys for
  | 'dtls-replayed' // the record was received before (RFC 6347 §4.1.2.6)
  | 'dtls-unauthentic' // it does not decrypt
  | 'dtls-out-of-order' // a handshake message that may not come now: repeated, left out, or a new handshake
  | 'dtls-early' // it came before the transport was ready for it, and more of them than are kept
  | 'sctp-malformed' // a packet whose lengths, checksum or chunks are not those of RFC 9260
  | 'sctp-failed' // a well-formed packet that werift could not handle
  | 'message-malformed'; // a data channel message (RFC 8832) that cannot be one

/** Counts what was dropped, by reason. */
export class Refusals {
  readonly #counts = new Map<Refusal, number>();
  readonly #onRefused: ((reason: Refusal) => void) | undefined;

  constructor(onRefused?: (reason: Refusal) => void) {
    this.#onRefused = onRefused;
  }

  add(reason: Refusal): void {
    this.#counts.set(reason, this.get(reason) + 1);
    this.#onRefused?.(reason);
  }

  get(reason: Refusal): number {
    return this.#counts.get(reason) ?? 0;
  }

  entries(): Iterable<[Refusal, number]> {
    return this.#counts.entries();
  }
}
