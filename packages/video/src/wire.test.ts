import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  FROM_PROCESS,
  MessageParser,
  parseEncoded,
  RAW_FORMATS,
  type RawFormat,
  rawFrameBytes,
  type WireMessage,
  writeCodedHead,
  writeConfigure,
  writeFrameHead,
  writeKeyFrame,
  writeMessage,
  writeOpen,
} from './wire.ts';

const types = fc.constantFrom(...Object.values(FROM_PROCESS));
const messages = fc.array(fc.record({ type: types, payload: fc.uint8Array({ maxLength: 300 }) }), {
  maxLength: 8,
});

/** Pushes bytes, cut where `cuts` says. */
function parse(bytes: Uint8Array, cuts: readonly number[], parser = new MessageParser()): WireMessage[] {
  const found: WireMessage[] = [];
  const edges = [0, ...cuts.map((cut) => cut % (bytes.length + 1)).sort((a, b) => a - b), bytes.length];
  for (let i = 1; i < edges.length; i++)
    parser.push(bytes.subarray(edges[i - 1], edges[i]), (message) => found.push(message));
  return found;
}

function concat(parts: readonly Uint8Array[]): Uint8Array {
  return new Uint8Array(Buffer.concat(parts));
}

const refused = (code: string) => expect.objectContaining({ name: 'WireError', code });

describe('messages', () => {
  it('come out as they were written, however they are cut', () => {
    fc.assert(
      fc.property(messages, fc.array(fc.nat(), { maxLength: 12 }), (given, cuts) => {
        const bytes = concat(given.map(({ type, payload }) => writeMessage(type, payload)));
        const found = parse(bytes, cuts);
        expect(found.map(({ type, payload }) => ({ type, payload: [...payload] }))).toEqual(
          given.map(({ type, payload }) => ({ type, payload: [...payload] })),
        );
      }),
    );
  });

  it('are not copied if they came in one piece', () => {
    const bytes = writeMessage(FROM_PROCESS.state, Uint8Array.of(1, 2, 3));
    expect(parse(bytes, [])[0]?.payload.buffer).toBe(bytes.buffer);
  });

  it('may have as many bytes as are allowed, and no more', () => {
    const at = (length: number) => writeMessage(FROM_PROCESS.encoded, new Uint8Array(length));
    expect(parse(at(10), [], new MessageParser(10))).toHaveLength(1);
    // Refused by the header alone.
    expect(() => parse(at(11).subarray(0, 5), [], new MessageParser(10))).toThrow(refused('too-large'));
  });

  it('of an unknown type are refused', () => {
    expect(() => parse(writeMessage(1, new Uint8Array(0)), [])).toThrow(refused('unknown-type'));
  });
});

describe('an encoded picture', () => {
  const payload = Uint8Array.from([
    ...[0x15, 0xcd, 0x5b, 0x07, 0, 0, 0, 0], // 123,456,789 ns
    ...[1, 0x00, 0x04, 0x00, 0x03, 0x88, 0x13, 0, 0], // key; 1024 × 768; 5000 µs
    ...[9, 8, 7],
  ]);

  it('is read', () => {
    expect(parseEncoded(payload)).toEqual({
      captureNs: 123_456_789n,
      captureMs: 123.456789,
      key: true,
      width: 1024,
      height: 768,
      encodeMs: 5,
      bytes: Uint8Array.of(9, 8, 7),
    });
  });

  it('keeps the fraction of a time that is years long', () => {
    const late = payload.slice();
    new DataView(late.buffer).setBigUint64(0, 300_000_000_123_456_000n, true);
    expect(parseEncoded(late).captureMs).toBeCloseTo(300_000_000_123.456, 3);
  });

  it('without bytes is refused', () => {
    for (let length = 0; length <= 17; length++)
      expect(() => parseEncoded(payload.subarray(0, length))).toThrow(refused('bad-message'));
  });
});

describe('what is sent', () => {
  const hex = (bytes: Uint8Array) => Buffer.from(bytes).toString('hex');

  it('has the bytes that native/main.c reads', () => {
    expect(hex(writeKeyFrame())).toBe('0000000003');
    expect(
      hex(writeConfigure({ bitsPerS: 1_000_000, framesPerS: 15, width: 640, height: 480, barcode: 'unix' })),
    ).toBe('0d00000002' + '40420f00' + '983a0000' + '8002' + 'e001' + '02');
    expect(hex(writeConfigure({ bitsPerS: 1 }))).toBe(`0d0000000201000000${'00'.repeat(9)}`);
    expect(
      Buffer.from(
        writeOpen([
          ['source', 'a=b'],
          ['name', 'ü'],
        ]).subarray(5),
      ).toString(),
    ).toBe('source=a=b\0name=ü\0');
    const bytes = new Uint8Array(6);
    const frame = { captureNs: 258n, format: 'gray', width: 3, height: 2, stride: 3, bytes } as const;
    expect(hex(writeFrameHead(frame))).toBe(
      '1700000004' + '0201000000000000' + '09' + '0300' + '0200' + '03000000',
    );
  });

  it('has the bytes that native/decode.c reads', () => {
    const picture = { captureNs: 258n, coding: 'vp8', bytes: new Uint8Array(6) } as const;
    expect(hex(writeCodedHead(picture, false))).toBe('1000000005' + '0201000000000000' + '04' + '00');
    expect(hex(writeCodedHead({ ...picture, coding: 'jpeg' }, true))).toBe(
      '1000000005' + '0201000000000000' + '01' + '01',
    );
  });

  it('has no zero byte in a text, which would begin another', () => {
    expect(() => writeOpen([['source', 'a\0encoder=b']])).toThrow(refused('bad-message'));
  });

  it('knows the bytes of a raw picture', () => {
    const bytesOf = (format: RawFormat) => rawFrameBytes({ format, height: 3, stride: 5 });
    expect(Object.keys(RAW_FORMATS).map((format) => bytesOf(format as RawFormat))).toEqual([
      ...[15 + 2 * 3 * 2, 15 + 5 * 2],
      ...[15, 15, 15, 15, 15, 15, 15],
    ]);
  });
});
