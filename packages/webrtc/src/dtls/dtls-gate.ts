/**
 * Guards a DTLS 1.2 endpoint that trusts its input. It passes on only what a strict endpoint would act on: during the
 * handshake, complete messages, each once and in order, with valid proofs; afterwards, only records that are authentic
 * under the session's keys. The endpoint keeps its own flights, keys and timers.
 *
 * An attacker on the path can still make a handshake fail, because nothing in it is authentic before its end. It can
 * never start, change or end a session.
 */
import type { KeyObject } from 'node:crypto';
import type { Refusals } from '../refusal.ts';
import { repeatsWithCookie } from './client-hello.ts';
import { HandshakeAssembler } from './handshake-assembler.ts';
import { type HandshakeMessage, HandshakeType, parseHandshakeFragments } from './handshake-message.ts';
import {
  checkCertificateVerify,
  checkFinished,
  checkServerKeyExchange,
  type Fingerprint,
  provenCertificateKey,
  UnprovenPeerError,
} from './peer-proof.ts';
import { ContentType, type DtlsRecord, parseRecords } from './record.ts';
import { ReplayWindow } from './replay-window.ts';

/** The endpoint behind the gate. */
export interface DtlsEndpoint {
  readonly role: 'server' | 'client';
  /** Of the peer's certificate, as the session description states. */
  readonly fingerprints: readonly Fingerprint[];
  /** The cookie that the server issued; empty before that. */
  readonly cookie: Buffer;
  /** `null` until the key exchange. */
  readonly masterSecret: Buffer | null;
  /** The client's and the server's, in that order. */
  readonly randoms: Buffer;
  /** Every handshake message so far, sent and received, as the proofs cover them. */
  transcript(): Buffer;
  /** @throws if the record is not authentic */
  decrypt(record: DtlsRecord): Buffer;
  /** The next message of the peer. */
  onHandshake(message: HandshakeMessage): void;
  /** The peer has not received our last flight. */
  resendFlight(): void;
  onData(plaintext: Buffer): void;
  /** The peer has closed or aborted the session. */
  onClosed(): void;
  onFailed(error: UnprovenPeerError): void;
}

/** Which messages of the peer may follow each other; `start` before the first. */
const ORDER: Record<'server' | 'client', Record<number | 'start', readonly number[]>> = {
  server: {
    start: [HandshakeType.clientHello],
    [HandshakeType.clientHello]: [HandshakeType.clientHello, HandshakeType.certificate],
    [HandshakeType.certificate]: [HandshakeType.clientKeyExchange],
    [HandshakeType.clientKeyExchange]: [HandshakeType.certificateVerify],
    [HandshakeType.certificateVerify]: [HandshakeType.finished],
    [HandshakeType.finished]: [],
  },
  client: {
    start: [HandshakeType.helloVerifyRequest, HandshakeType.serverHello],
    [HandshakeType.helloVerifyRequest]: [HandshakeType.serverHello],
    [HandshakeType.serverHello]: [HandshakeType.certificate],
    [HandshakeType.certificate]: [HandshakeType.serverKeyExchange],
    [HandshakeType.serverKeyExchange]: [HandshakeType.certificateRequest, HandshakeType.serverHelloDone],
    [HandshakeType.certificateRequest]: [HandshakeType.serverHelloDone],
    [HandshakeType.serverHelloDone]: [HandshakeType.finished],
    [HandshakeType.finished]: [],
  },
};
const ALERT_CLOSE_NOTIFY = 0;
const ALERT_FATAL = 2;
/** Limit on encrypted records that overtake the key exchange. */
const MAX_EARLY_RECORDS = 4;
/** Someone who repeats the first message endlessly must not make us answer for ever. */
const MAX_RESENDS = 20;

export class DtlsGate {
  readonly #endpoint: DtlsEndpoint;
  readonly #refusals: Refusals;
  readonly #assembler = new HandshakeAssembler();
  readonly #replay = new ReplayWindow();
  #state: 'handshake' | 'connected' | 'ended' = 'handshake';
  #last: number | 'start' = 'start';
  #firstHello: Buffer | null = null;
  #peerKey: KeyObject | null = null;
  #early: DtlsRecord[] = [];
  #resends = 0;

  constructor(endpoint: DtlsEndpoint, refusals: Refusals) {
    this.#endpoint = endpoint;
    this.#refusals = refusals;
  }

  /** Whether the peer has proved its identity, so that its data is passed on. */
  get connected(): boolean {
    return this.#state === 'connected';
  }

  /** Never throws, whatever the datagram contains. */
  onDatagram(datagram: Buffer): void {
    const { records, malformed } = parseRecords(datagram);
    for (const record of records) {
      if (this.#state === 'ended') return;
      if (record.epoch === 0) this.#onPlaintext(record);
      else if (record.epoch === 1) this.#onEncrypted(record);
      else this.#refusals.add('dtls-epoch');
    }
    if (malformed) this.#refusals.add('dtls-malformed');
  }

  #onPlaintext(record: DtlsRecord): void {
    const { contentType, fragment } = record;
    // It announces encrypted records, which their epoch shows anyway.
    if (contentType === ContentType.changeCipherSpec) return;
    if (contentType !== ContentType.handshake || this.#state !== 'handshake') {
      this.#refusals.add('dtls-plaintext');
      return;
    }
    this.#onFragments(fragment, false);
  }

  #onEncrypted(record: DtlsRecord): void {
    if (this.#endpoint.masterSecret === null) {
      if (this.#early.length < MAX_EARLY_RECORDS) {
        this.#early.push({ ...record, fragment: Buffer.from(record.fragment) });
      } else this.#refusals.add('dtls-early');
      return;
    }
    const isHandshake = record.contentType === ContentType.handshake;
    // A repeated last flight may have been encrypted only once.
    if (!isHandshake && this.#replay.has(record.sequence)) {
      this.#refusals.add('dtls-replayed');
      return;
    }
    let plaintext: Buffer;
    try {
      plaintext = this.#endpoint.decrypt(record);
    } catch {
      this.#refusals.add('dtls-unauthentic');
      return;
    }
    this.#replay.mark(record.sequence);
    if (isHandshake) this.#onFragments(plaintext, true);
    else if (record.contentType === ContentType.alert) this.#onAlert(plaintext);
    else if (record.contentType !== ContentType.applicationData) this.#refusals.add('dtls-out-of-order');
    else if (this.#state === 'connected') this.#endpoint.onData(plaintext);
    // Overtook the peer's Finished: SCTP retransmits it.
    else this.#refusals.add('dtls-out-of-order');
  }

  #onAlert(plaintext: Buffer): void {
    if (plaintext.length !== 2) {
      this.#refusals.add('dtls-malformed');
      return;
    }
    const [level, description] = plaintext;
    if (level !== ALERT_FATAL && description !== ALERT_CLOSE_NOTIFY) return;
    this.#state = 'ended';
    this.#endpoint.onClosed();
  }

  #onFragments(plaintext: Buffer, encrypted: boolean): void {
    const fragments = parseHandshakeFragments(plaintext);
    if (fragments === null) {
      this.#refusals.add('dtls-malformed');
      return;
    }
    for (const fragment of fragments) {
      // Finished is the only handshake message that is encrypted, and it must be.
      if ((fragment.type === HandshakeType.finished) !== encrypted) {
        this.#refusals.add('dtls-out-of-order');
        continue;
      }
      const fate = this.#state === 'connected' ? 'old' : this.#assembler.add(fragment);
      if (fate === 'old') this.#onRepeated(fragment.type);
      else if (fate !== 'kept') this.#refusals.add('dtls-malformed');
    }
    while (this.#state === 'handshake') {
      const message = this.#assembler.peek();
      if (message === null) break;
      this.#onMessage(message);
    }
  }

  #onMessage(message: HandshakeMessage): void {
    const { type, body } = message;
    if (!(ORDER[this.#endpoint.role][this.#last] ?? []).includes(type) || !this.#helloFits(type, body)) {
      this.#assembler.discard();
      this.#refusals.add('dtls-out-of-order');
      return;
    }
    try {
      this.#prove(type, body);
    } catch (error) {
      if (!(error instanceof UnprovenPeerError)) throw error;
      this.#state = 'ended';
      this.#endpoint.onFailed(error);
      return;
    }
    this.#assembler.take();
    this.#last = type;
    if (type === HandshakeType.clientHello) this.#firstHello ??= Buffer.from(body);
    if (type === HandshakeType.finished) this.#state = 'connected';
    this.#endpoint.onHandshake(message);
    if (this.#endpoint.masterSecret !== null) {
      for (const record of this.#early.splice(0)) this.#onEncrypted(record);
    }
  }

  /** A second hello must be the first plus the cookie that proves the peer's address; there is no third. */
  #helloFits(type: number, body: Buffer): boolean {
    if (type !== HandshakeType.clientHello || this.#firstHello === null) return true;
    if (this.#assembler.next !== 1) return false;
    return repeatsWithCookie(this.#firstHello, body, this.#endpoint.cookie);
  }

  #prove(type: number, body: Buffer): void {
    const endpoint = this.#endpoint;
    const key = this.#peerKey;
    if (type === HandshakeType.certificate) {
      this.#peerKey = provenCertificateKey(body, endpoint.fingerprints);
    } else if (type === HandshakeType.certificateVerify) {
      if (key === null) throw new UnprovenPeerError('bad-certificate');
      checkCertificateVerify(body, endpoint.transcript(), key);
    } else if (type === HandshakeType.serverKeyExchange) {
      if (key === null) throw new UnprovenPeerError('bad-certificate');
      checkServerKeyExchange(body, endpoint.randoms, key);
    } else if (type === HandshakeType.finished) {
      if (endpoint.masterSecret === null) throw new UnprovenPeerError('bad-finished');
      const sender = endpoint.role === 'server' ? 'client' : 'server';
      checkFinished(body, endpoint.transcript(), endpoint.masterSecret, sender);
    }
  }

  /** A peer that repeats its last flight has not received our answer. */
  #onRepeated(type: number): void {
    const { role } = this.#endpoint;
    const ended = this.#state === 'connected' && role === 'server' && type === HandshakeType.finished;
    const hello = this.#state === 'handshake' && this.#last === type && type === HandshakeType.clientHello;
    const done = this.#state === 'handshake' && role === 'client' && type === HandshakeType.serverHelloDone;
    if ((ended || hello || done) && this.#resends < MAX_RESENDS) {
      this.#resends++;
      this.#endpoint.resendFlight();
    } else this.#refusals.add('dtls-out-of-order');
  }
}
