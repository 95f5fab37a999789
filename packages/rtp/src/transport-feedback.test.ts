import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { parseTransportFeedback, TransportFeedbackError } from './transport-feedback.ts';

interface Valid {
  name: string;
  hex: string;
  senderSsrc: number;
  mediaSsrc: number;
  baseSequence: number;
  referenceTimeUs: number;
  feedbackCount: number;
  arrivalsUs: (number | null)[];
}
interface Invalid {
  name: string;
  hex: string;
  error: string;
}

const vectors = JSON.parse(
  readFileSync(new URL('../vectors/transport-feedback.json', import.meta.url), 'utf8'),
) as { valid: Valid[]; invalid: Invalid[] };

function bytesOf(hex: string): Uint8Array {
  return new Uint8Array(Buffer.from(hex, 'hex'));
}

function errorOf(bytes: Uint8Array): TransportFeedbackError | null {
  try {
    parseTransportFeedback(bytes);
    return null;
  } catch (error) {
    if (error instanceof TransportFeedbackError) return error;
    throw error;
  }
}

describe('conformance vectors', () => {
  test.each(vectors.valid)('$name', ({ hex, arrivalsUs, name: _name, ...expected }) => {
    const { packets, ...header } = parseTransportFeedback(bytesOf(hex));
    expect(header).toEqual(expected);
    expect(packets).toEqual(
      arrivalsUs.map((arrivalUs, i) => ({
        sequence: (expected.baseSequence + i) % 65_536,
        received: arrivalUs !== null,
        arrivalUs,
      })),
    );
  });

  test.each(vectors.invalid)('refuses: $name', ({ hex, error }) => {
    expect(errorOf(bytesOf(hex))?.code).toBe(error);
  });
});

test('reads a view that does not begin at the start of its buffer', () => {
  const { hex } = vectors.valid[0] as Valid;
  const room = new Uint8Array(hex.length / 2 + 7);
  room.set(bytesOf(hex), 7);
  expect(parseTransportFeedback(room.subarray(7))).toEqual(parseTransportFeedback(bytesOf(hex)));
});

test('the error says where the fault is', () => {
  const { hex } = vectors.invalid.find(({ name }) => name === 'a small delta missing') as Invalid;
  const error = errorOf(bytesOf(hex));
  expect(error?.offset).toBe(24);
  expect(error?.message).toBe('transport feedback, byte 24: no receive delta for packet 3');
});

/** Writes feedback in the simplest way the draft allows: one run-length chunk per packet. */
function encode(base: number, reference: number, deltas: (number | null)[]): Uint8Array {
  const chunks: number[] = [];
  const tail: number[] = [];
  for (const delta of deltas) {
    if (delta === null) chunks.push(0x00, 0x01);
    else if (delta >= 0 && delta < 256) {
      chunks.push(0x20, 0x01);
      tail.push(delta);
    } else {
      chunks.push(0x40, 0x01);
      tail.push((delta >> 8) & 0xff, delta & 0xff);
    }
  }
  const content = [...chunks, ...tail];
  while (content.length % 4 !== 0) content.push(0);
  const bytes = new Uint8Array(20 + content.length);
  const view = new DataView(bytes.buffer);
  view.setUint16(0, 0x8fcd);
  view.setUint16(2, bytes.length / 4 - 1);
  view.setUint16(12, base);
  view.setUint16(14, deltas.length);
  view.setUint32(16, (reference << 8) >>> 0);
  bytes.set(content, 20);
  return bytes;
}

test('round trip of any statuses', () => {
  const delta = fc.oneof(
    fc.constant(null),
    fc.integer({ min: 0, max: 255 }),
    fc.integer({ min: -32768, max: 32767 }),
  );
  fc.assert(
    fc.property(
      fc.integer({ min: 0, max: 0xffff }),
      fc.integer({ min: -(2 ** 23), max: 2 ** 23 - 1 }),
      fc.array(delta, { minLength: 1, maxLength: 200, size: 'max' }),
      (base, reference, deltas) => {
        let time = reference * 64_000;
        const expected = deltas.map((d) => {
          time += (d ?? 0) * 250;
          return d === null ? null : time;
        });
        const { packets } = parseTransportFeedback(encode(base, reference, deltas));
        expect(packets.map((p) => p.arrivalUs)).toEqual(expected);
        expect(packets.map((p) => p.sequence)).toEqual(deltas.map((_, i) => (base + i) & 0xffff));
      },
    ),
    { seed: 1, numRuns: 300 },
  );
});

test('forty bytes do not become 65,535 objects', () => {
  const bytes = new Uint8Array(40);
  const view = new DataView(bytes.buffer);
  view.setUint16(0, 0x8fcd);
  view.setUint16(2, 9);
  for (let at = 20; at < 40; at += 2) view.setUint16(at, 0x1fff);
  view.setUint16(14, 16_384);
  expect(parseTransportFeedback(bytes).packets).toHaveLength(16_384);
  view.setUint16(14, 16_385);
  expect(errorOf(bytes)?.code).toBe('too-many');
});

test('any bytes give feedback or a typed error', () => {
  const outcomes = new Map<string, number>();
  const judge = (bytes: Uint8Array) => {
    const outcome = errorOf(bytes)?.code ?? 'feedback';
    outcomes.set(outcome, (outcomes.get(outcome) ?? 0) + 1);
  };
  fc.assert(fc.property(fc.uint8Array({ maxLength: 200, size: 'max' }), judge), { seed: 2, numRuns: 2000 });
  // A valid header, then anything.
  const behindHeader = fc
    .tuple(
      fc.integer({ min: 4, max: 30 }),
      fc.boolean(),
      fc.uint8Array({ minLength: 120, maxLength: 120, size: 'max' }),
    )
    .map(([words, padded, noise]) => {
      const bytes = new Uint8Array((words + 1) * 4);
      bytes.set(noise.subarray(0, bytes.length - 4), 4);
      bytes.set([padded ? 0xaf : 0x8f, 205, 0, words]);
      if (noise[0] !== 0) bytes.set([0, 1 + ((noise[1] as number) % 40)], 14);
      return bytes;
    });
  fc.assert(fc.property(behindHeader, judge), { seed: 3, numRuns: 5000 });
  for (const vector of [...vectors.valid, ...vectors.invalid]) {
    const bytes = bytesOf(vector.hex);
    for (let at = 0; at < Math.min(bytes.length, 40); at++) {
      for (const flip of [0x01, 0x80, 0xff]) {
        const mutated = bytes.slice();
        mutated[at] = (mutated[at] as number) ^ flip;
        judge(mutated);
      }
      judge(bytes.subarray(0, at));
    }
  }
  // Every outcome occurred.
  expect([...outcomes.keys()].sort()).toEqual([
    'bad-length',
    'bad-padding',
    'empty',
    'feedback',
    'not-transport-feedback',
    'reserved-status',
    'too-many',
    'truncated',
  ]);
});
