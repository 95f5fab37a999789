/** The numbers of which coded meshes are made: unsigned and signed integers of few bytes, and floats. */
import { ProtocolError } from './errors.ts';

const WHAT = 'meshes of the model';
const MAX_VARINT_BYTES = 4;

/** @returns always throws @throws {ProtocolError} */
export function refuseMeshes(path: string, detail: string): never {
  throw new ProtocolError('invalid', WHAT, path, detail);
}

/** Writes into memory that grows. */
export class MeshBytesWriter {
  #bytes = new Uint8Array(4096);
  #length = 0;

  /** Seven bits a byte, the lowest first; the highest bit says that another follows. */
  unsigned(value: number): void {
    let left = value;
    for (; left > 0x7f; left >>>= 7) this.byte((left & 0x7f) | 0x80);
    this.byte(left);
  }

  /** Small values of either sign are small. */
  signed(value: number): void {
    this.unsigned(value < 0 ? -2 * value - 1 : 2 * value);
  }

  byte(value: number): void {
    if (this.#length === this.#bytes.length) {
      const larger = new Uint8Array(this.#bytes.length * 2);
      larger.set(this.#bytes);
      this.#bytes = larger;
    }
    this.#bytes[this.#length++] = value;
  }

  float(value: number): void {
    const bytes = new Uint8Array(4);
    new DataView(bytes.buffer).setFloat32(0, value, true);
    for (const each of bytes) this.byte(each);
  }

  done(): Uint8Array {
    return this.#bytes.slice(0, this.#length);
  }
}

/** Reads what {@link MeshBytesWriter} writes. */
export class MeshBytesReader {
  readonly #bytes: Uint8Array;
  readonly #view: DataView;
  #at = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get left(): number {
    return this.#bytes.length - this.#at;
  }

  /** @param most the largest that is accepted @throws {ProtocolError} */
  unsigned(path: string, most: number): number {
    let value = 0;
    for (let i = 0; i < MAX_VARINT_BYTES; i++) {
      const byte = this.byte(path);
      value |= (byte & 0x7f) << (7 * i);
      if (byte > 0x7f) continue;
      if (value > most) refuseMeshes(path, `must be at most ${most}`);
      return value;
    }
    return refuseMeshes(path, `must have at most ${MAX_VARINT_BYTES} bytes`);
  }

  /** @throws {ProtocolError} */
  signed(path: string, most: number): number {
    const value = this.unsigned(path, 2 * most);
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  /** @throws {ProtocolError} */
  byte(path: string): number {
    if (this.#at >= this.#bytes.length) refuseMeshes(path, 'is missing');
    return this.#bytes[this.#at++] as number;
  }

  /** @param most the largest magnitude that is accepted @throws {ProtocolError} */
  float(path: string, most: number): number {
    if (this.left < 4) refuseMeshes(path, 'is missing');
    const value = this.#view.getFloat32(this.#at, true);
    this.#at += 4;
    if (!(Math.abs(value) <= most)) refuseMeshes(path, `must be within ±${most}`);
    return value;
  }
}
