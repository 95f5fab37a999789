import { thrown } from '@farpoint/service/testing/thrown';
import { describe, expect, it } from 'vitest';
import { RosFault } from './fault.ts';
import {
  foxgloveCompressedImageSchema,
  foxgloveCompressedVideoSchema,
  foxgloveRawImageSchema,
  stampNs,
} from './messages.ts';
import { imageFromProtobuf } from './protobuf-image.ts';

/** As written by PyPI's protobuf 7.36 and foxglove-schemas-protobuf 0.4. */
const COMPRESSED = '0a0c0880e2cfaa061080cab5ee0112030102031a046a706567220566726f6e74';
const RAW =
  '0a1108ffffffffffffffffff0110ff93ebdc0315020000001d010000002204726762382d2c01000032060001020304053a0566726f6e74';
const VIDEO = '0a080880e2cfaa06107b120546726f6e741a06000001650102220468323634';

const readCompressed = (bytes: Uint8Array) =>
  foxgloveCompressedImageSchema.parse(imageFromProtobuf('foxglove.CompressedImage')?.(bytes));
const readRaw = (bytes: Uint8Array) =>
  foxgloveRawImageSchema.parse(imageFromProtobuf('foxglove.RawImage')?.(bytes));
const hex = (text: string) => Uint8Array.from(Buffer.from(text, 'hex'));

describe('imageFromProtobuf', () => {
  it('reads what the schemas’ own library writes', () => {
    const image = readCompressed(hex(COMPRESSED));
    expect(image).toMatchObject({ frame_id: 'front', format: 'jpeg', data: Uint8Array.of(1, 2, 3) });
    expect(stampNs(image.timestamp)).toBe(1_700_000_000_500_000_000n);
    const raw = readRaw(hex(RAW));
    expect(raw).toMatchObject({ width: 2, height: 1, step: 300, encoding: 'rgb8', frame_id: 'front' });
    expect(raw.data).toEqual(Uint8Array.of(0, 1, 2, 3, 4, 5));
    expect(stampNs(raw.timestamp)).toBe(-1n);
  });

  it('reads a frame of a video', () => {
    const frame = foxgloveCompressedVideoSchema.parse(
      imageFromProtobuf('foxglove.CompressedVideo')?.(hex(VIDEO)),
    );
    expect(frame).toMatchObject({
      frame_id: 'Front',
      format: 'h264',
      data: Uint8Array.of(0, 0, 1, 0x65, 1, 2),
    });
    expect(stampNs(frame.timestamp)).toBe(1_700_000_000_000_000_123n);
  });

  it('uses defaults for missing fields, skips unknown ones, and takes the last of duplicates', () => {
    expect(readCompressed(new Uint8Array(0))).toMatchObject({ format: '', data: new Uint8Array(0) });
    // Field 100 as text, 101 as a number, 102 and 103 as eight and four bytes; then another format.
    const more = `${COMPRESSED}a206026964a8060db1060102030405060708bd060a0b0c0d1a03706e67`;
    expect(readCompressed(hex(more))).toMatchObject({ format: 'png', data: Uint8Array.of(1, 2, 3) });
    // The same field number with another wire type is not one of its fields.
    expect(readCompressed(hex('1005'))).toMatchObject({ data: new Uint8Array(0) });
  });

  it('knows no other names', () => {
    expect(imageFromProtobuf('foxglove.PointCloud')).toBeNull();
    expect(imageFromProtobuf('toString')).toBeNull();
  });

  it('reports at which byte a truncated message ends', () => {
    const whole = hex(COMPRESSED);
    // Between two fields, it is a complete message with fewer fields.
    const between = [0, 14, 19, 25, 32];
    for (let length = 0; length <= whole.length; length++) {
      const read = () => readCompressed(whole.subarray(0, length));
      if (between.includes(length)) expect(read, `${length} bytes`).not.toThrow();
      else {
        const { code, offset } = thrown(RosFault, read);
        expect(code).toBe('bad-message');
        expect(offset).toBeLessThanOrEqual(length);
      }
    }
  });
});
