/**
 * Stream header of the format `unorganised`: what its receivers agree on, 8 bytes, little-endian.
 *
 *     0  4 bytes  `FPUC`
 *     4  u8       version, 1
 *     5  u8       0
 *     6  u16      unit of the receivers' int16 coordinates, millimetres, at least 1: the farthest point fits
 */
import { ProtocolError } from './errors.ts';

export interface UnorganisedStream {
  unitMm: number;
}

const MAGIC = [0x46, 0x50, 0x55, 0x43];
const BYTES = 8;
const VERSION = 1;
const WHAT = 'unorganised stream header';

export function encodeUnorganisedStream({ unitMm }: UnorganisedStream): Uint8Array<ArrayBuffer> {
  return Uint8Array.of(...MAGIC, VERSION, 0, unitMm & 0xff, unitMm >> 8);
}

/** @throws {ProtocolError} `too-short`, `too-large`, `invalid` */
export function decodeUnorganisedStream(bytes: Uint8Array): UnorganisedStream {
  if (bytes.length !== BYTES) {
    const code = bytes.length < BYTES ? 'too-short' : 'too-large';
    throw new ProtocolError(code, WHAT, '', `${bytes.length} bytes, not ${BYTES}`);
  }
  if (MAGIC.some((byte, i) => bytes[i] !== byte))
    throw new ProtocolError('invalid', WHAT, 'magic', 'not FPUC');
  if (bytes[4] !== VERSION)
    throw new ProtocolError('invalid', WHAT, 'version', `${bytes[4]}, not ${VERSION}`);
  const unitMm = (bytes[6] as number) | ((bytes[7] as number) << 8);
  if (unitMm === 0) throw new ProtocolError('invalid', WHAT, 'unitMm', '0');
  return { unitMm };
}
