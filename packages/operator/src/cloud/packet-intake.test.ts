import { emptyPlacement, writePlacement, writePointPacketHeader } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { PacketIntake } from './packet-intake.ts';

function payload(points: number, frameNumber = 1): DataView {
  const view = new DataView(new ArrayBuffer(16 + points * 8 + 28));
  const sequenceLength = points * 8;
  writePointPacketHeader(view, 0, {
    frameNumber,
    frameLength: sequenceLength,
    sequenceOffset: 0,
    sequenceLength,
  });
  writePlacement(view, 16 + sequenceLength, emptyPlacement());
  return view;
}

describe('PacketIntake', () => {
  test('reads well-formed payloads and counts bytes', () => {
    const intake = new PacketIntake();
    expect(intake.take(payload(3, 9), 0)).toBe(null);
    expect(intake.header.frameNumber).toBe(9);
    expect(intake.bytesReceived).toBe(16 + 24 + 28);
  });

  test('counts faults by reason', () => {
    const intake = new PacketIntake();
    intake.take(new DataView(new ArrayBuffer(3)), 0);
    intake.take(new DataView(new ArrayBuffer(3)), 1);
    const wrongFormat = payload(1);
    wrongFormat.setUint8(wrongFormat.byteLength - 1, 99);
    intake.take(wrongFormat, 2);
    expect(intake.drops).toEqual({ 'too-short': 2, 'unknown-format': 1 });
    expect(intake.packetsReceived).toBe(3);
    expect(intake.packetsLost).toBe(0);
  });

  test('counts gaps in the sequence as losses until they are filled, across the wrap', () => {
    const intake = new PacketIntake();
    for (const sequence of [65_533, 65_534, 1, 2]) intake.take(payload(1), sequence);
    expect(intake.packetsLost).toBe(2);
    intake.take(payload(1), 65_535);
    expect(intake.packetsLost).toBe(1);
    intake.take(payload(1), 0);
    expect(intake.packetsLost).toBe(0);
  });

  test('counts no losses without sequence numbers', () => {
    const intake = new PacketIntake();
    for (let i = 0; i < 5; i++) intake.take(payload(1), undefined);
    expect(intake.packetsLost).toBe(0);
  });

  test('counts losses correctly in any order of arrival', () => {
    const fates = fc.array(fc.record({ lost: fc.boolean(), delay: fc.nat(20) }), {
      minLength: 1,
      maxLength: 200,
    });
    fc.assert(
      fc.property(fates, fc.nat(65_535), (packets, start) => {
        const intake = new PacketIntake();
        const arrivals = packets
          .map(({ lost, delay }, i) => ({ sequence: (start + i) & 0xffff, i, lost, at: i + delay }))
          .filter(({ lost }) => !lost)
          .sort((a, b) => a.at - b.at);
        for (const { sequence } of arrivals) intake.take(payload(1), sequence);
        const received = arrivals.map(({ i }) => i);
        const span = received.length === 0 ? 0 : Math.max(...received) - Math.min(...received) + 1;
        expect(intake.packetsLost).toBe(span - received.length);
      }),
      { seed: 6 },
    );
  });

  test('counts any bytes without throwing', () => {
    const intake = new PacketIntake();
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 1400 }), fc.nat(65_535), (bytes, sequence) => {
        intake.take(new DataView(bytes.buffer, bytes.byteOffset, bytes.length), sequence);
      }),
      { seed: 8 },
    );
    expect(Object.values(intake.drops).reduce((sum, count) => sum + count, 0)).toBe(100);
  });
});
