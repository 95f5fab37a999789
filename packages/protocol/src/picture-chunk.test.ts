import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import {
  emptyPictureChunkHeader,
  MAX_PICTURE_BYTES,
  PICTURE_FORMATS,
  type PictureChunkFault,
  type PictureChunkHeader,
  type PictureHeader,
  pictureChunks,
  readPictureChunk,
  writePictureChunk,
} from './picture-chunk.ts';
import { readVectors } from './testing/vectors.ts';

interface ReadVector {
  name: string;
  hex: string;
  header?: PictureChunkHeader;
  dataBytes?: number;
  fault?: PictureChunkFault;
}
const vectors = readVectors<{
  read: ReadVector[];
  pictures: { name: string; header: PictureHeader; pictureHex: string; chunksHex: string[] }[];
}>('picture-chunk');

function chunksOf(header: PictureHeader, picture: Uint8Array): Uint8Array[] {
  return Array.from({ length: pictureChunks(picture.length) }, (_, index) => {
    const room = new Uint8Array(1200);
    return room.subarray(0, writePictureChunk(header, picture, index, room));
  });
}

function read(bytes: Uint8Array) {
  const header = emptyPictureChunkHeader();
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return { fault: readPictureChunk(view, header), header };
}

describe('conformance vectors', () => {
  test.each(vectors.read)('read: $name', ({ hex, header, dataBytes, fault }) => {
    const bytes = Buffer.from(hex, 'hex');
    const got = read(bytes);
    expect(got.fault).toBe(fault ?? null);
    if (header === undefined) return;
    expect(got.header).toEqual(header);
    expect(bytes.length - 20).toBe(dataBytes);
  });

  test.each(vectors.pictures)('write: a picture $name', ({ header, pictureHex, chunksHex }) => {
    const chunks = chunksOf(header, Buffer.from(pictureHex, 'hex'));
    expect(chunks.map((chunk) => Buffer.from(chunk).toString('hex'))).toEqual(chunksHex);
  });
});

test('any bytes give a header within its bounds, or a fault', () => {
  const good = vectors.read.filter(({ fault }) => fault === undefined);
  const faults = new Set<string | null>();
  fc.assert(
    fc.property(
      fc.constantFrom(...good),
      fc.array(fc.tuple(fc.nat(19), fc.nat(255)), { maxLength: 3 }),
      fc.oneof(fc.constant(0), fc.integer({ min: -1300, max: 10 })),
      ({ hex }, changes, grow) => {
        const source = Buffer.from(hex, 'hex');
        const bytes = new Uint8Array(Math.max(0, source.length + grow));
        bytes.set(source.subarray(0, bytes.length));
        for (const [at, value] of changes) if (at < bytes.length) bytes[at] = value;
        const { fault, header } = read(bytes);
        faults.add(fault);
        if (fault !== null) return;
        expect(header.index).toBeLessThan(header.count);
        expect(header.count).toBeLessThanOrEqual(512);
        expect(header.camera).toBeLessThan(8);
        expect(Math.max(header.width, header.height)).toBeLessThanOrEqual(4096);
        expect(PICTURE_FORMATS).toContain(header.format);
      },
    ),
    { seed: 1, numRuns: 3000 },
  );
  expect(faults.size).toBeGreaterThan(6);
});

test('the largest picture takes the maximum number of chunks', () => {
  expect(pictureChunks(MAX_PICTURE_BYTES)).toBe(512);
  expect(pictureChunks(MAX_PICTURE_BYTES + 1)).toBe(513);
});
