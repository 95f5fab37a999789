/** Why something that arrived on a socket was dropped. Nothing dropped reached werift or changed any state. */
export type Refusal =
  | 'stun-unauthenticated' // a STUN request without a MESSAGE-INTEGRITY of our session (RFC 8445 §7.3)
  | 'unknown-source' // no connectivity check of our session has come from, or gone to, this address
  | 'dtls-malformed' // no DTLS record, or a handshake fragment that contradicts itself
  | 'dtls-plaintext' // epoch 0 although everything is encrypted, or an unauthenticated alert
  | 'dtls-epoch' // an epoch for which this session has no keys
  | 'dtls-replayed' // the record was received before (RFC 6347 §4.1.2.6)
  | 'dtls-unauthentic' // it does not decrypt
  | 'dtls-out-of-order' // a handshake message that is not allowed now: repeated, skipped, or a new handshake
  | 'dtls-early' // it arrived before the transport was ready, and the buffer for such packets is full
  | 'stun-too-long' // no check or answer is as long
  | 'stun-rate-limited' // authentic, but more checks than a peer needs
  | 'stun-replayed' // an authentic check again, from another address than the first time
  | 'ice-too-many-sources' // authentic, from another new address, after more of them than a peer has
  | 'rtcp-replayed' // the packet was received before (RFC 3711 §3.3.2)
  | 'rtcp-malformed' // longer than a path takes, of too many parts, or reporting on more packets than were sent
  | 'rtcp-rate-limited' // authentic, but more than a receiver has to say
  | 'rtp-unasked' // media from a peer that was offered no m-line for it
  | 'rtp-too-many-sources' // authentic, under another new SSRC, after more of them than a peer has
  | 'sctp-malformed' // a packet whose lengths, checksum or chunks violate RFC 9260
  | 'sctp-rate-limited' // more work than a peer may make; it sends again what it must
  | 'sctp-out-of-order' // it begins an association that is established
  | 'sctp-false-ack' // it acknowledges what was never sent
  | 'sctp-overfull' // too many fragments, streams or bytes that wait for others; ends the session
  | 'too-many-channels' // opened one after the other; ends the session
  | 'message-too-large' // longer than our description allows; ends the session
  | 'sctp-failed' // a well-formed packet that werift could not handle
  | 'message-malformed'; // an invalid data channel message (RFC 8832)

/** Counts dropped packets by reason. */
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
