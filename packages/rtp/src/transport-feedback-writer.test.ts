import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { parseTransportFeedback } from './transport-feedback.ts';
import { writeTransportFeedback } from './transport-feedback-writer.ts';

const common = { senderSsrc: 1, mediaSsrc: 0xfedcba98, feedbackCount: 255 };

describe('writeTransportFeedback', () => {
  it('can be read back, arrivals within half a step', () => {
    const gap = fc.oneof(fc.nat(500), fc.integer({ min: -20_000, max: 100_000 }), fc.constant(null));
    fc.assert(
      fc.property(
        fc.nat(0xffff),
        fc.nat(2 ** 29),
        fc.array(gap, { minLength: 1, maxLength: 300 }),
        (baseSequence, beginUs, gaps) => {
          let now = beginUs + 10_000_000;
          const arrivalsUs = [now];
          for (const us of gaps) {
            now += us ?? 0;
            arrivalsUs.push(us === null ? Number.NaN : now);
          }
          const read = parseTransportFeedback(
            writeTransportFeedback({ ...common, baseSequence, arrivalsUs }),
          );
          expect(read).toMatchObject({ ...common, baseSequence });
          expect(read.packets.length).toBe(arrivalsUs.length);
          for (const [i, { sequence, received, arrivalUs }] of read.packets.entries()) {
            expect(sequence).toBe((baseSequence + i) & 0xffff);
            const meant = arrivalsUs[i] as number;
            expect(received).toBe(!Number.isNaN(meant));
            if (received) expect(Math.abs((arrivalUs as number) - meant)).toBeLessThanOrEqual(125);
          }
        },
      ),
      { seed: 11 },
    );
  });

  it('encodes runs in few bytes', () => {
    const arrivalsUs = Array.from({ length: 700 }, (_, i) => (i === 350 ? Number.NaN : i * 100));
    const bytes = writeTransportFeedback({ ...common, baseSequence: 65_500, arrivalsUs });
    expect(bytes.length).toBeLessThan(20 + 2 * 4 + 699 + 4);
    expect(parseTransportFeedback(bytes).packets.filter(({ received }) => !received).length).toBe(1);
  });

  it('refuses what cannot be represented', () => {
    const write = (arrivalsUs: number[]) => () =>
      writeTransportFeedback({ ...common, baseSequence: 0, arrivalsUs });
    expect(write([])).toThrow(RangeError);
    expect(write([Number.NaN])).toThrow(RangeError);
    expect(write([0, 9_000_000])).toThrow(RangeError);
  });
});
