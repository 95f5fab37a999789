/**
 * Reads the fields of a ROS 2 message one after the other, in the order of its definition. Source: DDSI-RTPS 2.5, 10.2
 * (header), and CORBA’s CDR: each number is aligned to its own size, counted from behind the header. Pure.
 */
import { RosFault } from './fault.ts';
import { ENCAPSULATION_BYTES } from './wire-check.ts';

/** Longer texts are cut: they are for people. Chosen: more than a line; cdr-fields.test.ts holds it. */
const MOST_TEXT = 4096;

export class CdrFields {
  readonly #bytes: Uint8Array;
  readonly #view: DataView;
  readonly #little: boolean;
  #at = ENCAPSULATION_BYTES;

  /** @throws {RosFault} `bad-message` if the bytes are not CDR */
  constructor(bytes: Uint8Array) {
    const [first, kind, ...rest] = bytes.subarray(0, ENCAPSULATION_BYTES);
    if (rest.length < 2) throw new RosFault('bad-message', 'it is cut short', { offset: bytes.length });
    // Version 1 of CDR, in which rmw_cyclonedds writes, in either byte order.
    if (first !== 0 || kind === undefined || kind > 1)
      throw new RosFault('bad-message', 'it is not CDR as ROS 2 writes it', { offset: 0 });
    this.#bytes = bytes;
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.#little = kind === 1;
  }

  /** How many bytes are left. */
  get left(): number {
    return this.#bytes.length - this.#at;
  }

  /** @returns a view of the message @throws {RosFault} `bad-message` */
  bytes(count: number): Uint8Array {
    if (count > this.left) throw new RosFault('bad-message', 'it is cut short', { offset: this.#at });
    this.#at += count;
    return this.#bytes.subarray(this.#at - count, this.#at);
  }

  /** @throws {RosFault} `bad-message` */
  int8(): number {
    return ((this.bytes(1)[0] as number) << 24) >> 24;
  }

  /** @throws {RosFault} `bad-message`: also for what is neither true nor false */
  bool(): boolean {
    const value = this.int8();
    if (value === 0 || value === 1) return value === 1;
    throw new RosFault('bad-message', `${value} is neither true nor false`, { offset: this.#at - 1 });
  }

  /** @throws {RosFault} `bad-message` */
  uint32(): number {
    this.bytes((ENCAPSULATION_BYTES - this.#at) & 3);
    this.bytes(4);
    return this.#view.getUint32(this.#at - 4, this.#little);
  }

  /** Its length in bytes, with the zero at its end, comes first. @throws {RosFault} `bad-message` */
  text(): string {
    const bytes = this.bytes(this.uint32());
    const end = bytes.at(-1) === 0 ? bytes.length - 1 : bytes.length;
    return new TextDecoder().decode(bytes.subarray(0, Math.min(end, MOST_TEXT)));
  }
}
