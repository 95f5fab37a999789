/**
 * Stands before a DTLS 1.2 endpoint that believes what it is told, and lets through what a strict endpoint would act on:
 * whole handshake messages, each once and in order, whose proofs hold; after the handshake nothing but authentic records
 * of its keys. The endpoint keeps its flights, its keys and its timers.
 *
 * A path's own bytes may still fail a handshake, for nothing in it is authentic before its end; they never start, change or
 * end a session.
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
  /** Of the peer's certificate, as its description says. */
  readonly fingerprints: readonly Fingerprint[];
  /** That a server gave out; empty before. */
  readonly cookie: Buffer;
  /** `null` until the key exchange. */
  readonly masterSecret: Buffer | null;
  /** The client's and the server's, in that order. */
  readonly randoms: Buffer;
  /** Every message of the handshake so far, sent and received, as the proofs count them. */
  transcript(): Buffer;
  /** @throws where the record is not authentic */
  decrypt(record: DtlsRecord): Buffer;
  /** The next message of the peer. */
  onHandshake(message: HandshakeMessage): void;
  /** The peer has not had our last flight. */
  resendFlight(): void;
  onData(plaintext: Buffer): void;
  /** The peer has closed the session, or given it up. */
  onClosed(): void;
  onFailed(error: UnprovenPeerError): void;
}

/** What may follow each message of the peer; `start` before the first. */
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
/** Encrypted records that overtook the key exchange. */
const MAX_EARLY_RECORDS = 4;
/** An endless repetition of somebody's first message must not make us talk for ever. */
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

  /** The peer has proved itself, and its data is let through. */
  get connected(): boolean {
    return this.#state === 'connected';
  }

  /** Never throws for what the datagram holds. */
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
    // It says that encrypted records follow, which their epoch says too.
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
    // A repeated last flight may have been sealed only once.
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
    // Overtook the peer's Finished: SCTP sends it again.
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
      // Finished is the one message that is encrypted, and the one that must be.
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

  /** A second hello is the first with the cookie that proves the peer's address; there is no third. */
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

  /** Repeats its last flight who has not had our answer to it. */
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
