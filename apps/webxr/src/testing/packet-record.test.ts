import { BATCH_BYTES, Batch } from '@farpoint/operator';
import { emptyPlacement } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { PacketRecord } from './packet-record.ts';

function batchOf(offsets: number[]): Batch {
  const batch = new Batch(new ArrayBuffer(BATCH_BYTES));
  for (const sequenceOffset of offsets) {
    const header = { frameNumber: 7, frameLength: 9600, sequenceOffset, sequenceLength: 1200 };
    batch.add(header, emptyPlacement(), 150, 1000.5 + sequenceOffset, {
      imageExtent: 2,
      unit: 0.001,
      cover: 2,
    });
  }
  return batch;
}

describe('PacketRecord', () => {
  it('returns frame, offset and arrival on the requested clock', () => {
    const record = new PacketRecord(10);
    record.add(batchOf([0, 1200]), 1000);
    expect([...record.values]).toEqual([7, 0, 0.5, 7, 1200, 1200.5]);
  });

  it('keeps the first packets when it is full', () => {
    const record = new PacketRecord(1);
    record.add(batchOf([0, 1200]), 1000);
    record.add(batchOf([2400]), 1000);
    expect([...record.values]).toEqual([7, 0, 0.5]);
  });
});
