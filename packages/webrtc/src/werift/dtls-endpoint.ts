/** Adapts werift's DTLS socket to the interface of the gate. */
import { Buffer } from 'node:buffer';
import type { CipherGCMTypes, KeyObject } from 'node:crypto';
import type { RTCDtlsTransport } from 'werift';
import type { DtlsEndpoint } from '../dtls/dtls-gate.ts';
import { type HandshakeMessage, HandshakeType, serializeHandshake } from '../dtls/handshake-message.ts';
import { openRecord, type RecordKeys } from '../dtls/open-record.ts';
import type { Fingerprint, UnprovenPeerError } from '../dtls/peer-proof.ts';
import { ContentType, type DtlsRecord, parseRecords } from '../dtls/record.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

interface Serializable {
  serialize(): Buffer;
}

/** An AES-GCM suite; werift has no others. */
interface SuiteShape {
  blockAlgorithm: CipherGCMTypes;
  clientWriteKey: KeyObject | Uint8Array;
  serverWriteKey: KeyObject | Uint8Array;
  clientNonce: Uint8Array;
  serverNonce: Uint8Array;
}

/** What `DtlsServer` and `DtlsClient` have in common. */
export interface DtlsSocketShape {
  sessionType: number;
  transport: {
    send: (bytes: Buffer) => Promise<unknown>;
    socket: { onData: (datagram: Buffer) => void };
  };
  dtls: {
    flight: number;
    recordSequenceNumber: number;
    cookie?: Buffer;
    lastMessage: Buffer[];
    sortedHandshakeCache: Serializable[];
  };
  cipher: {
    cipher?: SuiteShape;
    masterSecret?: Buffer;
    localRandom?: Serializable;
    remoteRandom?: Serializable;
  };
  onHandleHandshakes(messages: unknown[]): Promise<void>;
  onData: { execute(plaintext: Buffer): void };
  onClose: { execute(): void };
  onError: { execute(error: Error): void };
}

const SERVER_SESSION = 2;
/** The flight in which a server requests its cookie. */
const COOKIE_FLIGHT = 2;

/** @throws {WeriftShapeError} */
export function asDtlsSocket(socket: unknown): DtlsSocketShape {
  if (typeof socket !== 'object' || socket === null) throw new WeriftShapeError('no DTLS socket');
  const shape = socket as DtlsSocketShape;
  expectMethods(shape, 'the DTLS socket', ['onHandleHandshakes']);
  expectMethods(shape.transport, 'the DTLS transport', ['send']);
  expectMethods(shape.transport.socket, 'the DTLS transport', ['onData']);
  for (const event of ['onData', 'onClose', 'onError'] as const) {
    expectMethods(shape[event], `the DTLS socket's ${event}`, ['execute']);
  }
  if (!Array.isArray(shape.dtls.sortedHandshakeCache) || !Array.isArray(shape.dtls.lastMessage)) {
    throw new WeriftShapeError('no handshake in the DTLS socket');
  }
  return shape;
}

export class WeriftDtlsEndpoint implements DtlsEndpoint {
  readonly #socket: DtlsSocketShape;
  readonly #transport: RTCDtlsTransport;
  readonly #onUnproven: (error: UnprovenPeerError) => void;
  #cookieRequest: Buffer | null = null;

  constructor(
    socket: DtlsSocketShape,
    transport: RTCDtlsTransport,
    onUnproven: (error: UnprovenPeerError) => void,
  ) {
    this.#socket = socket;
    this.#transport = transport;
    this.#onUnproven = onUnproven;
    const send = socket.transport.send;
    socket.transport.send = (bytes) => {
      this.#onSent(bytes);
      return send(bytes);
    };
  }

  get role(): 'server' | 'client' {
    return this.#socket.sessionType === SERVER_SESSION ? 'server' : 'client';
  }

  get fingerprints(): readonly Fingerprint[] {
    const { remoteParameters } = this.#transport as unknown as {
      remoteParameters?: { fingerprints: Fingerprint[] };
    };
    return remoteParameters?.fingerprints ?? [];
  }

  get cookie(): Buffer {
    return this.#socket.dtls.cookie ?? Buffer.alloc(0);
  }

  get masterSecret(): Buffer | null {
    const { cipher, masterSecret } = this.#socket.cipher;
    return cipher === undefined ? null : (masterSecret ?? null);
  }

  get randoms(): Buffer {
    const { localRandom, remoteRandom } = this.#socket.cipher;
    if (localRandom === undefined || remoteRandom === undefined) return Buffer.alloc(0);
    const both = [localRandom.serialize(), remoteRandom.serialize()];
    return Buffer.concat(this.role === 'client' ? both : both.reverse());
  }

  transcript(): Buffer {
    return Buffer.concat(this.#socket.dtls.sortedHandshakeCache.map((message) => message.serialize()));
  }

  /** werift itself describes each record that is not authentic, with its bytes: a quarter of a millisecond. */
  decrypt(record: DtlsRecord): Buffer {
    return openRecord(record, this.#peerKeys());
  }

  onHandshake(message: HandshakeMessage): void {
    const { type, messageSequence, body } = message;
    const handshake = {
      msg_type: type,
      length: body.length,
      message_seq: messageSequence,
      fragment_offset: 0,
      fragment_length: body.length,
      fragment: body,
      summary: {},
      serialize: () => serializeHandshake(message),
    };
    this.#socket
      .onHandleHandshakes([handshake])
      .catch((error: unknown) => this.#socket.onError.execute(error as Error));
  }

  resendFlight(): void {
    const { flight, lastMessage } = this.#socket.dtls;
    const buffers = flight === COOKIE_FLIGHT ? [this.#cookieRequest] : lastMessage;
    for (const bytes of buffers) {
      if (bytes !== null) this.#socket.transport.send(bytes).catch(() => undefined);
    }
  }

  onData(plaintext: Buffer): void {
    this.#socket.onData.execute(plaintext);
  }

  onClosed(): void {
    this.#socket.onClose.execute();
  }

  onFailed(error: UnprovenPeerError): void {
    this.#onUnproven(error);
    this.#socket.onError.execute(error);
  }

  /** What the peer seals with. */
  #peerKeys(): RecordKeys {
    const suite = this.#socket.cipher.cipher;
    if (suite === undefined) throw new WeriftShapeError('no DTLS cipher');
    const { blockAlgorithm: algorithm, clientWriteKey, clientNonce, serverWriteKey, serverNonce } = suite;
    return this.role === 'client'
      ? { algorithm, key: serverWriteKey, implicitNonce: serverNonce }
      : { algorithm, key: clientWriteKey, implicitNonce: clientNonce };
  }

  #onSent(bytes: Buffer): void {
    const first = parseRecords(bytes).records[0];
    if (first?.contentType !== ContentType.handshake) return;
    if (first.epoch === 0) {
      if (first.fragment[0] === HandshakeType.helloVerifyRequest) this.#cookieRequest = bytes;
      return;
    }
    // werift restarts the numbering of encrypted records after its Finished, and would encrypt one of them with the
    // same nonce. RFC 5288 §3 forbids this: two records with one nonce reveal both plaintexts and the authentication
    // key.
    const { dtls } = this.#socket;
    dtls.recordSequenceNumber = Math.max(dtls.recordSequenceNumber, first.sequence);
  }
}
