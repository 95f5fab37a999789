import { Buffer } from 'node:buffer';
import type { Socket } from 'node:dgram';
import { isIP } from 'node:net';
import { type Addon, MOST_DATAGRAMS, readSending, type Sending } from './addon.ts';
import { SocketDescriptor } from './socket-descriptor.ts';

/** Room for a full batch of packets that fit Ethernet. */
const ROOM_BYTES = MOST_DATAGRAMS * 1500;

/** An IPv6 address, %, and the name of an interface. */
const MOST_ADDRESS_CHARACTERS = 64;

/** How many datagrams left in which way. */
export interface SendCounters {
  /** By the addon, together with others of the same turn. */
  batched: number;
  /** Handed to Node, one by one. */
  single: number;
  /** Refused by the system, then or later, or by a closed socket. */
  failed: number;
}

/**
 * Collects the datagrams that are sent on one socket in one turn of the event loop, and sends them together at its end,
 * by one system call. What the kernel does not take at once goes through Node, which queues it, as does everything
 * without the addon and on a socket that is not as expected.
 */
export class DatagramBatch {
  readonly #counters: SendCounters;
  readonly #socket: Socket;
  readonly #addon: Addon | null;
  readonly #descriptor: SocketDescriptor | null;
  readonly #bytes: Buffer;
  readonly #lengths = new Uint32Array(MOST_DATAGRAMS);
  /** `null` until the kernel has been asked whether it knows them. */
  #segments: boolean | null = null;
  #address = '';
  #port = 0;
  #count = 0;
  #used = 0;
  #scheduled = false;
  /** Datagrams that Node was given and has not sent yet. */
  #waiting = 0;
  readonly #onSent = (error: Error | null): void => {
    this.#waiting--;
    if (error !== null) this.#counters.failed++;
  };

  /**
   * @param addon `null` if there is none
   * @param counters counted up; several batches may share them
   */
  constructor(socket: Socket, addon: Addon | null, counters: SendCounters) {
    this.#socket = socket;
    this.#counters = counters;
    this.#addon = addon;
    this.#descriptor = addon === null ? null : new SocketDescriptor(socket, addon);
    this.#bytes = Buffer.allocUnsafeSlow(addon === null ? 0 : ROOM_BYTES);
  }

  /**
   * Sends the parts as one datagram, at the end of this turn at the latest. Never throws.
   *
   * @param parts must not be changed before the next turn
   * @param address numeric, IPv4 or IPv6
   */
  send(parts: readonly Uint8Array[], port: number, address: string): void {
    let length = 0;
    for (const part of parts) length += part.length;
    if (!this.#makeRoom(length, port, address)) {
      this.#sendSingle(parts, port, address);
      return;
    }
    let at = this.#used;
    for (const part of parts) {
      this.#bytes.set(part, at);
      at += part.length;
    }
    this.#used = at;
    this.#lengths[this.#count++] = length;
    if (this.#scheduled) return;
    this.#scheduled = true;
    queueMicrotask(() => {
      this.#scheduled = false;
      this.flush();
    });
  }

  /** Sends what has been collected. */
  flush(): void {
    const count = this.#count;
    if (count === 0) return;
    const sent = this.#sendTogether(count);
    this.#counters.batched += sent;
    let at = 0;
    for (let i = 0; i < count; i++) {
      const length = this.#lengths[i] as number;
      // Node may keep it, and this memory is used again.
      if (i >= sent)
        this.#sendSingle([Buffer.from(this.#bytes.subarray(at, at + length))], this.#port, this.#address);
      at += length;
    }
    this.#count = 0;
    this.#used = 0;
  }

  /** @returns false if such a datagram cannot be in a batch; those before it have then been sent */
  #makeRoom(length: number, port: number, address: string): boolean {
    if (this.#addon === null) return false;
    const isElsewhere = port !== this.#port || address !== this.#address;
    if (isElsewhere || this.#count === MOST_DATAGRAMS || this.#used + length > ROOM_BYTES) this.flush();
    if (length > ROOM_BYTES || (isElsewhere && !isDestination(port, address))) return false;
    this.#port = port;
    this.#address = address;
    return true;
  }

  /** @returns how many of the first `count` datagrams the kernel took */
  #sendTogether(count: number): number {
    const addon = this.#addon;
    // What waits in Node leaves first.
    const fd = this.#waiting > 0 ? null : (this.#descriptor?.get() ?? null);
    if (addon === null || fd === null) return 0;
    this.#segments ??= addon.knowsSegments(fd);
    const call = (bytes: Uint8Array, lengths: Uint32Array, of: number): Sending =>
      readSending(addon.send(fd, this.#address, this.#port, bytes, lengths, of, this.#segments === true));
    const { sent, stop } = call(this.#bytes, this.#lengths, count);
    if (stop !== 'segments') return sent;
    this.#segments = false;
    const bytesSent = this.#lengths.subarray(0, sent).reduce((sum, length) => sum + length, 0);
    return sent + call(this.#bytes.subarray(bytesSent), this.#lengths.subarray(sent), count - sent).sent;
  }

  #sendSingle(parts: readonly Uint8Array[], port: number, address: string): void {
    try {
      this.#socket.send(parts as Uint8Array[], port, address, this.#onSent);
      this.#waiting++;
      this.#counters.single++;
    } catch {
      // Closed, or nothing that one could send to.
      this.#counters.failed++;
    }
  }
}

/** Anything else is for Node to resolve or to refuse. */
function isDestination(port: number, address: string): boolean {
  if (!Number.isInteger(port) || port < 1 || port > 0xffff) return false;
  return address.length <= MOST_ADDRESS_CHARACTERS && isIP(address) !== 0;
}
