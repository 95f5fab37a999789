/** What a packet of a peer makes the association do, counted at a stand-in for werift's. */
import { beforeEach, describe, expect, it } from 'vitest';
import { MAX_STREAMS } from '../sctp/receive-bound.ts';
import { MAX_AHEAD } from '../sctp/tsn-window.ts';
import { boundSctp } from './bound-sctp.ts';

type Gap = [number, number];

class Stream {
  streamSequenceNumber = 0;
  pops = 0;
  readonly pruned: number[] = [];

  popMessages(): [number, number, Buffer][] {
    this.pops++;
    return [];
  }

  pruneChunks(tsn: number): number {
    this.pruned.push(tsn);
    return 100;
  }
}

const LAST = 1000;

function standIn() {
  return {
    isStopped: false,
    lastReceivedTsn: LAST as number | undefined,
    localTsn: 520,
    lastSackedTsn: 499,
    advertisedRwnd: 5000,
    sackNeeded: false,
    sackImmediate: false,
    sackPacketCount: 0,
    inboundStreams: {} as Record<number, Stream>,
    outboundStreamSeq: {} as Record<number, number>,
    outboundQueue: [] as { tsn: number }[],
    sent: [] as Buffer[],
    sacks: [] as { cumulativeTsn: number; gaps: Gap[] }[],
    reset: [] as number[][],
    markReceived: (_: number): boolean => true,
    sendSack: async () => undefined,
    sendChunk: async ({ bytes }: { bytes: Buffer }) => {
      association.sent.push(bytes);
    },
    receiveForwardTsnChunk: (_: { cumulativeTsn: number; streams: Gap[] }) => undefined,
    receiveSackChunk: async (sack: { cumulativeTsn: number; gaps: Gap[] }) => {
      association.sacks.push(sack);
    },
    receiveReconfigParam: async ({ streams }: { type: number; streams: number[] }) => {
      association.reset.push(streams);
    },
    getInboundStream: (id: number) => (association.inboundStreams[id] ??= new Stream()),
    receive: () => undefined,
  };
}

let association: ReturnType<typeof standIn>;
let isRepeated: (tsn: number) => boolean;
let excess: string[];
let falseAcks: number;

beforeEach(() => {
  association = standIn();
  excess = [];
  falseAcks = 0;
  isRepeated = boundSctp(association, {
    onExcess: (what) => excess.push(what),
    onFalseAck: () => falseAcks++,
  });
});

/** Last number in order, and the gap blocks, of the SACK that is sent now. */
async function acknowledged(): Promise<{ last: number; blocks: Gap[]; repeated: number; bytes: number }> {
  await association.sendSack();
  const bytes = association.sent.at(-1)!;
  const blocks = Array.from(
    { length: bytes.readUInt16BE(12) },
    (_, n): Gap => [bytes.readUInt16BE(16 + 4 * n), bytes.readUInt16BE(18 + 4 * n)],
  );
  return { last: bytes.readUInt32BE(4), blocks, repeated: bytes.readUInt16BE(14), bytes: bytes.length };
}

describe('numbers that arrive', () => {
  it('are acknowledged in order and beyond gaps, where werift’s text order would mix 999 and 1,000', async () => {
    association.lastReceivedTsn = 995;
    for (const tsn of [997, 999, 1000, 1002]) {
      expect(isRepeated(tsn)).toBe(false);
      expect(association.markReceived(tsn)).toBe(false);
    }
    association.sackNeeded = true;
    expect(await acknowledged()).toMatchObject({
      last: 995,
      blocks: [
        [2, 2],
        [4, 5],
        [7, 7],
      ],
    });
    association.markReceived(996);
    expect(association.lastReceivedTsn).toBe(997);
  });

  it('are acknowledged in one packet, however many gaps and repetitions there are', async () => {
    for (let tsn = LAST + 2; tsn <= LAST + MAX_AHEAD; tsn += 2) association.markReceived(tsn);
    for (let n = 0; n < 500; n++) expect(isRepeated(LAST + 2)).toBe(true);
    const sack = await acknowledged();
    expect(sack.blocks.at(-1)).toEqual([512, 512]);
    expect(sack.repeated).toBe(16);
    expect(sack.bytes).toBeLessThan(1191);
    // Nothing is left to say.
    await association.sendSack();
    expect(association.sent).toHaveLength(1);
  });

  it('are followed when an association begins, also with 0, before which werift puts -1', async () => {
    association.lastReceivedTsn = -1;
    expect(association.markReceived(1)).toBe(false);
    expect(association.markReceived(0)).toBe(false);
    expect(association.lastReceivedTsn).toBe(1);
  });

  it('are worth nothing before it begins', async () => {
    association.lastReceivedTsn = undefined;
    association.sackNeeded = true;
    expect(isRepeated(5)).toBe(false);
    expect(association.markReceived(5)).toBe(true);
    await association.sendSack();
    expect(association.sent).toEqual([]);
  });
});

describe('FORWARD TSN', () => {
  it('looks at each stream once, however often it is named', () => {
    const streams = new Array<Gap>(290).fill([3, 7]);
    association.receiveForwardTsnChunk({ cumulativeTsn: LAST + 5, streams });
    expect(association.inboundStreams[3]).toMatchObject({ pops: 1, streamSequenceNumber: 8 });
    expect(association.lastReceivedTsn).toBe(LAST + 5);
  });

  it('begins no more streams than DATA may', () => {
    const streams = Array.from({ length: MAX_STREAMS + 1 }, (_, id): Gap => [id, 0]);
    association.receiveForwardTsnChunk({ cumulativeTsn: LAST + 1, streams: streams.slice(1) });
    expect(excess).toEqual([]);
    association.receiveForwardTsnChunk({ cumulativeTsn: LAST + 2, streams });
    expect(excess).toEqual(['sctp-overfull']);
    expect(Object.keys(association.inboundStreams)).toHaveLength(MAX_STREAMS);
  });

  it('does nothing for an old number, except that it is acknowledged', async () => {
    association.receiveForwardTsnChunk({ cumulativeTsn: LAST, streams: [[3, 7]] });
    expect(association.inboundStreams).toEqual({});
    expect(await acknowledged()).toMatchObject({ last: LAST });
  });

  it('takes nothing away from a message that arrived behind what is given up', () => {
    association.getInboundStream(1);
    for (const tsn of [LAST + 2, LAST + 3]) association.markReceived(tsn);
    association.receiveForwardTsnChunk({ cumulativeTsn: LAST + 1, streams: [] });
    expect(association.lastReceivedTsn).toBe(LAST + 3);
    expect(association.inboundStreams[1]!.pruned).toEqual([LAST + 1]);
    expect(association.advertisedRwnd).toBe(5100);
  });
});

describe('SACK', () => {
  it('is read as far as something was sent', async () => {
    // 500 … 509 are sent, the others wait.
    association.outboundQueue = [{ tsn: 510 }];
    await association.receiveSackChunk({
      cumulativeTsn: 501,
      gaps: [
        [2, 3],
        [6, 65_535],
      ],
    });
    expect(association.sacks).toEqual([
      {
        cumulativeTsn: 501,
        gaps: [
          [2, 3],
          [6, 8],
        ],
      },
    ]);
    await association.receiveSackChunk({ cumulativeTsn: 501, gaps: [[9, 65_535]] });
    expect(association.sacks[1]).toEqual({ cumulativeTsn: 501, gaps: [] });
  });

  it('is not believed if it acknowledges what was never sent', async () => {
    await association.receiveSackChunk({ cumulativeTsn: 520, gaps: [] });
    expect(association.sacks).toEqual([]);
    expect(falseAcks).toBe(1);
    await association.receiveSackChunk({ cumulativeTsn: 519, gaps: [] });
    expect(association.sacks).toHaveLength(1);
  });

  it('is read where the numbers wrap', async () => {
    Object.assign(association, { lastSackedTsn: -1, localTsn: 3 });
    await association.receiveSackChunk({ cumulativeTsn: 2 ** 32 - 1, gaps: [[1, 900]] });
    expect(association.sacks[0]!.gaps).toEqual([[1, 3]]);
  });
});

describe('RE-CONFIG', () => {
  it('resets streams that are there, each once', async () => {
    association.getInboundStream(4);
    association.outboundStreamSeq[6] = 1;
    const streams = Array.from({ length: 580 }, (_, n) => n % 290);
    await association.receiveReconfigParam({ type: 13, streams });
    expect(association.reset).toEqual([[4, 6]]);
  });
});
