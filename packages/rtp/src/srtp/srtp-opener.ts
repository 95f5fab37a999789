/**
 * Decrypts SRTP of incoming streams with AES-128-GCM (RFC 7714 §8). Finds each packet's index (RFC 3711 §3.3.1), and
 * refuses packets that were modified or received before (§3.3.2).
 */
import type { Buffer } from 'node:buffer';
import { createDecipheriv } from 'node:crypto';
import { SequenceNumber } from '../sequence-number.ts';
import { SRTP_GCM_TAG_BYTES, SrtpNonce } from './srtp-nonce.ts';

/** Replay window in packets; packets older than this are refused. */
const WINDOW = 4096;
const MAX_STREAMS = 4;

/** Why a packet is not decrypted. */
export type SrtpDrop = 'too-short' | 'replayed' | 'not-authentic' | 'too-many-streams';

interface Stream {
  /** Index of the newest authentic packet. */
  newest: number;
  /** For each index modulo the window, the index that was last received. */
  readonly seen: Float64Array;
}

export class SrtpOpener {
  readonly drops: Partial<Record<SrtpDrop, number>> = {};
  readonly #nonce: SrtpNonce;
  readonly #streams = new Map<number, Stream>();

  /**
   * @param key session key, 16 bytes
   * @param salt session salt; only the first 12 bytes count
   */
  constructor(key: Uint8Array, salt: Uint8Array) {
    this.#nonce = new SrtpNonce(key, salt);
  }

  /**
   * @param packet as received
   * @param headerBytes length of its RTP header, including the extension
   * @returns the payload, or `null` if the packet was dropped and counted
   */
  open(packet: Buffer, headerBytes: number): Buffer | null {
    if (packet.length < headerBytes + SRTP_GCM_TAG_BYTES || headerBytes < 12) return this.#drop('too-short');
    const sequence = packet.readUInt16BE(2);
    const ssrc = packet.readUInt32BE(8);
    const stream = this.#streams.get(ssrc);
    if (stream === undefined && this.#streams.size >= MAX_STREAMS) return this.#drop('too-many-streams');
    const index = stream === undefined ? sequence : indexOf(sequence, stream.newest);
    if (index < 0 || (stream !== undefined && wasSeen(stream, index))) return this.#drop('replayed');
    const payload = this.#decipher(packet, headerBytes, ssrc, index);
    if (payload === null) return this.#drop('not-authentic');
    this.#note(ssrc, stream, index);
    return payload;
  }

  #decipher(packet: Buffer, headerBytes: number, ssrc: number, index: number): Buffer | null {
    const tagAt = packet.length - SRTP_GCM_TAG_BYTES;
    const decipher = createDecipheriv('aes-128-gcm', this.#nonce.key, this.#nonce.of(ssrc, index));
    decipher.setAAD(packet.subarray(0, headerBytes));
    decipher.setAuthTag(packet.subarray(tagAt));
    const payload = decipher.update(packet.subarray(headerBytes, tagAt));
    try {
      decipher.final();
    } catch {
      return null;
    }
    return payload;
  }

  #note(ssrc: number, stream: Stream | undefined, index: number): void {
    let noted = stream;
    if (noted === undefined) {
      noted = { newest: index, seen: new Float64Array(WINDOW).fill(-1) };
      this.#streams.set(ssrc, noted);
    }
    noted.newest = Math.max(noted.newest, index);
    noted.seen[index % WINDOW] = index;
  }

  #drop(reason: SrtpDrop): null {
    this.drops[reason] = (this.drops[reason] ?? 0) + 1;
    return null;
  }
}

/** The index nearest to the newest one that ends with this sequence number; negative if there is none. */
function indexOf(sequence: number, newest: number): number {
  return newest + SequenceNumber.ahead(sequence, newest);
}

function wasSeen({ newest, seen }: Stream, index: number): boolean {
  return newest - index >= WINDOW || seen[index % WINDOW] === index;
}
