import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { abandonMessage, dropOverdue, isWorthless, type OutboundChunk } from './abandonment.ts';

const [LAST, FIRST] = [1, 2];
const NOW_S = 1000;

interface Chunk extends OutboundChunk {
  message: number;
}

/** Messages of so many fragments each, numbered from `tsn` on; the first `sentCount` of them are sent. */
function queues(lengths: readonly number[], sentCount: number, tsn = 1): { sent: Chunk[]; waiting: Chunk[] } {
  const chunks = lengths.flatMap((length, message) =>
    Array.from({ length }, (_, at) => ({
      message,
      flags: (at === 0 ? FIRST : 0) | (at === length - 1 ? LAST : 0),
    })),
  );
  const all = chunks.map((chunk, i) => ({
    ...chunk,
    ...{ tsn: (tsn + i) >>> 0, abandoned: false, retransmit: false, acked: false },
    sentCount: i < sentCount ? 1 : 0,
  }));
  return { sent: all.slice(0, sentCount), waiting: all.slice(sentCount) };
}

describe('isWorthless', () => {
  it('is what was sent again as often as allowed, or is too old', () => {
    const [chunk] = queues([1], 1).sent as [Chunk];
    expect(isWorthless({ ...chunk, sentCount: 9 }, NOW_S)).toBe(false);
    expect(isWorthless({ ...chunk, maxRetransmits: 0 }, NOW_S)).toBe(true);
    expect(isWorthless({ ...chunk, maxRetransmits: 1 }, NOW_S)).toBe(false);
    expect(isWorthless({ ...chunk, maxRetransmits: 1, sentCount: 2 }, NOW_S)).toBe(true);
    expect(isWorthless({ ...chunk, expiry: NOW_S }, NOW_S)).toBe(false);
    expect(isWorthless({ ...chunk, expiry: NOW_S - 0.001 }, NOW_S)).toBe(true);
  });
});

describe('dropOverdue', () => {
  const UNORDERED = 4;

  /** Which of the messages are unordered, and which overdue. */
  const fates = fc.array(
    fc.record({ length: fc.integer({ min: 1, max: 4 }), unordered: fc.boolean(), overdue: fc.boolean() }),
    { maxLength: 10 },
  );

  it('drops whole messages that nobody has begun to send, and leaves no gap in the numbers', () => {
    fc.assert(
      fc.property(fates, fc.nat(3), fc.constantFrom(1, 2 ** 32 - 3), (messages, begun, tsn) => {
        // Of the first message, some may be on its way.
        const sentCount = messages.length === 0 ? 0 : Math.min(begun, messages[0]!.length - 1);
        const { waiting } = queues(
          messages.map(({ length }) => length),
          sentCount,
          tsn,
        );
        for (const chunk of waiting) {
          const { unordered, overdue } = messages[chunk.message]!;
          chunk.flags |= unordered ? UNORDERED : 0;
          chunk.expiry = overdue ? NOW_S - 1 : NOW_S + 1;
        }
        const all = [...waiting];
        const stays = ({ message }: Chunk) =>
          (message === 0 && sentCount > 0) || !messages[message]!.unordered || !messages[message]!.overdue;
        const dropped = dropOverdue(waiting, NOW_S);
        expect(waiting).toEqual(all.filter(stays));
        expect(dropped).toBe(all.length - waiting.length);
        expect(waiting.map((chunk) => chunk.tsn)).toEqual(waiting.map((_, n) => (tsn + sentCount + n) >>> 0));
      }),
      { seed: 6, numRuns: 300 },
    );
  });

  it('leaves what has no time limit', () => {
    const { waiting } = queues([2, 1], 0);
    for (const chunk of waiting) Object.assign(chunk, { flags: chunk.flags | UNORDERED, maxRetransmits: 0 });
    expect(dropOverdue(waiting, NOW_S)).toBe(0);
    expect(waiting).toHaveLength(3);
  });
});

describe('abandonMessage', () => {
  it('gives up all fragments of the message, also those that were not sent, and no other', () => {
    fc.assert(
      fc.property(
        fc.array(fc.integer({ min: 1, max: 5 }), { minLength: 1, maxLength: 8 }),
        fc.nat(),
        fc.nat(),
        fc.constantFrom(1, 2 ** 32 - 3),
        (lengths, sentShare, pick, tsn) => {
          const total = lengths.reduce((sum, length) => sum + length, 0);
          const sentCount = 1 + (sentShare % total);
          const { sent, waiting } = queues(lengths, sentCount, tsn);
          const all = [...sent, ...waiting];
          const chunk = sent[pick % sentCount]!;
          const underway = abandonMessage(chunk, { sent, waiting });
          const own = all.filter(({ message }) => message === chunk.message);
          expect(all.filter(({ abandoned }) => abandoned)).toEqual(own);
          // The peer is told of what was sent, or counts as sent: all of the message, in the order of the numbers.
          expect([...sent, ...waiting]).toEqual(all);
          expect(sent).toEqual(expect.arrayContaining(own));
          expect(underway).toEqual(own.filter((one) => one !== chunk && one.sentCount > 0));
        },
      ),
    );
  });

  it('does not count what arrived, or waits to be sent again, as on its way', () => {
    const { sent, waiting } = queues([4], 4);
    sent[0]!.acked = true;
    sent[1]!.retransmit = true;
    expect(abandonMessage(sent[2]!, { sent, waiting })).toEqual([sent[3]]);
    expect(sent.some(({ retransmit }) => retransmit)).toBe(false);
  });

  it('does nothing for a chunk that is acknowledged meanwhile', () => {
    const { sent, waiting } = queues([2], 2);
    const chunk = sent.shift()!;
    expect(abandonMessage(chunk, { sent, waiting })).toEqual([]);
    expect(sent[0]!.abandoned).toBe(false);
  });
});
