/** The remote descriptions of a werift connection, and the peer's ICE candidates for them. */
import type { IceCandidate } from '@farpoint/protocol';
import type { RTCPeerConnection } from 'werift';
import { CandidateGate, type CandidateRefusal, takeCandidates } from '../ice/candidate-gate.ts';
import { guardLookups } from './ice-sockets.ts';

/** Characters of a refusal’s detail in the log. Chosen: a candidate’s line fits. */
const MAX_DETAIL = 300;

/**
 * Passes a peer's candidates to werift when they can be used. While a description is being set, werift would add
 * candidates one after the other before it connects, and wait up to 10 s for each mDNS name. It would also give up as
 * soon as the peer knows no more candidates and no pair works. Here, each name is looked up while the connection is
 * being made. The peer's end of candidates is not passed on, because its checks may still produce a peer-reflexive pair
 * (RFC 8863); the caller sets the time limit.
 */
export class RemoteCandidates {
  readonly #connection: RTCPeerConnection;
  readonly #onRefused: (reason: CandidateRefusal, detail: string) => void;
  readonly #gate = new CandidateGate();

  /** @param onRefused called for each candidate that is left out; others may still work */
  constructor(
    connection: RTCPeerConnection,
    onRefused: (reason: CandidateRefusal, detail: string) => void = () => undefined,
  ) {
    this.#connection = connection;
    this.#onRefused = onRefused;
  }

  /** A new description was requested, and candidates that arrive from now on may belong to it. */
  hold(): void {
    this.#gate.hold();
  }

  /**
   * Sets the remote description, then adds its candidates and those that waited for it.
   *
   * @throws {Error} if the description is unusable
   */
  async describe(type: 'offer' | 'answer', text: string): Promise<void> {
    const { sdp, candidates, fragments } = takeCandidates(text);
    this.#gate.hold();
    await this.#connection.setRemoteDescription({ type, sdp });
    const waited = this.#gate.open(fragments);
    for (const candidate of candidates) this.add(candidate);
    for (const candidate of waited) this.add(candidate);
  }

  /** May be called at any time, in any order. Never throws. */
  add(candidate: IceCandidate): void {
    const verdict = this.#gate.take(candidate);
    if (verdict === 'wait' || verdict === 'end') return;
    if (verdict !== 'add') {
      this.#onRefused(verdict, candidate.candidate.slice(0, MAX_DETAIL));
      return;
    }
    const { candidate: text, sdpMid, sdpMLineIndex } = candidate;
    this.#connection
      .addIceCandidate({
        candidate: text,
        ...(sdpMid == null ? {} : { sdpMid }),
        ...(sdpMLineIndex == null ? {} : { sdpMLineIndex }),
      })
      .catch((error: unknown) => {
        const detail = error instanceof Error ? error.message : String(error);
        this.#onRefused('unusable', detail.slice(0, MAX_DETAIL));
      });
    guardLookups(this.#connection);
  }
}
