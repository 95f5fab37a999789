import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { MOST_DELAY_MS, type PlayedVoice, VoiceBuffer } from './voice-buffer.ts';

/** 20 ms of CELT, told apart by its second byte. */
const opus = (mark: number) => new Uint8Array([31 << 3, mark & 0xff]);
const FIRST = { sequence: 65_530, timestamp: 0xffff_f000 };

function send(buffer: VoiceBuffer, index: number, nowMs: number): void {
  const { sequence, timestamp } = FIRST;
  buffer.push((sequence + index) & 0xffff, (timestamp + index * 960) >>> 0, opus(index), nowMs);
}

function takeAll(buffer: VoiceBuffer, nowMs: number): PlayedVoice[] {
  const taken: PlayedVoice[] = [];
  for (let next = buffer.take(nowMs); next !== null; next = buffer.take(nowMs)) taken.push(next);
  return taken;
}

const marks = (played: readonly PlayedVoice[]) => played.map(({ bytes }) => bytes[1] ?? 'concealed');

describe('a voice', () => {
  it('is handed on at once, to be heard evenly, over the wrap of both numbers', () => {
    const buffer = new VoiceBuffer();
    const played: PlayedVoice[] = [];
    for (let i = 0; i < 20; i++) {
      send(buffer, i, 1000 + i * 20 + (i % 3));
      played.push(...takeAll(buffer, 1000 + i * 20 + (i % 3)));
    }
    expect(marks(played)).toEqual(Array.from({ length: 20 }, (_, i) => i));
    expect(played.map(({ hearAtMs }) => Math.round(hearAtMs))).toEqual(played.map((_, i) => 1040 + i * 20));
    expect(buffer.drops).toEqual({});
  });

  it('is put in order, and a packet is waited for until its turn', () => {
    const buffer = new VoiceBuffer();
    send(buffer, 0, 1000);
    takeAll(buffer, 1000);
    send(buffer, 2, 1030);
    expect(takeAll(buffer, 1030)).toEqual([]);
    // Its turn is at 1060, less what decoding takes.
    expect(buffer.nextDueMs).toBeCloseTo(1055);
    send(buffer, 1, 1050);
    expect(marks(takeAll(buffer, 1050))).toEqual([1, 2]);
  });

  it('has a lost packet concealed in its turn', () => {
    const buffer = new VoiceBuffer();
    send(buffer, 0, 1000);
    takeAll(buffer, 1000);
    send(buffer, 2, 1040);
    expect(takeAll(buffer, 1054)).toEqual([]);
    const played = takeAll(buffer, 1055);
    expect(marks(played)).toEqual(['concealed', 2]);
    expect(played.map(({ hearAtMs }) => Math.round(hearAtMs))).toEqual([1060, 1080]);
    expect(buffer.concealed).toBe(1);
    send(buffer, 1, 1056);
    expect(takeAll(buffer, 1056)).toEqual([]);
    expect(buffer.drops).toEqual({ late: 1 });
  });

  it('is heard later when packets come late, by no more than the bound', () => {
    const buffer = new VoiceBuffer();
    for (let i = 0; i < 10; i++) {
      send(buffer, i, 1000 + i * 20);
      takeAll(buffer, 1000 + i * 20);
    }
    let heard: PlayedVoice[] = [];
    for (let i = 10; i < 40; i++) {
      send(buffer, i, 1060 + i * 20);
      heard = takeAll(buffer, 1060 + i * 20);
    }
    expect(heard).toHaveLength(1);
    expect(buffer.delayMs).toBeGreaterThan(65);
    for (let i = 40; i < 80; i++) {
      send(buffer, i, 1300 + i * 20);
      takeAll(buffer, 1300 + i * 20);
    }
    expect(buffer.delayMs).toBe(MOST_DELAY_MS);
    expect(buffer.drops.late).toBeGreaterThan(20);
  });

  it('that pauses is taken up again', () => {
    const buffer = new VoiceBuffer();
    send(buffer, 0, 1000);
    takeAll(buffer, 1000);
    // The sender’s timestamps go on while it is silent, its numbers do not.
    buffer.push(65_531, (FIRST.timestamp + 96_000) >>> 0, opus(1), 3000);
    expect(marks(takeAll(buffer, 3000))).toEqual([1]);
    buffer.push(65_532, 77, opus(2), 9000);
    const [last] = takeAll(buffer, 9000);
    expect(last?.hearAtMs).toBeGreaterThan(9000);
    expect(last?.hearAtMs).toBeLessThanOrEqual(9000 + MOST_DELAY_MS);
  });

  it('repeats nothing', () => {
    const buffer = new VoiceBuffer();
    send(buffer, 0, 1000);
    send(buffer, 0, 1001);
    expect(takeAll(buffer, 1001)).toHaveLength(1);
    send(buffer, 2, 1002);
    send(buffer, 2, 1003);
    expect(buffer.drops).toEqual({ duplicate: 2 });
  });

  it('from a peer that sends anything stays within its bounds', () => {
    const step = fc.record({
      sequence: fc.nat(0xffff),
      timestamp: fc.nat(0xffff_ffff),
      near: fc.boolean(),
      bytes: fc.oneof(
        fc.uint8Array({ maxLength: 20 }),
        fc.constant(opus(1)),
        fc.constant(new Uint8Array([(31 << 3) | 3, 6, 1])),
      ),
      afterMs: fc.oneof(fc.nat(3), fc.nat(2000)),
    });
    fc.assert(
      fc.property(fc.array(step, { maxLength: 200 }), (steps) => {
        const buffer = new VoiceBuffer();
        let nowMs = 5000;
        let endMs = 0;
        for (const [i, { sequence, timestamp, near, bytes, afterMs }] of steps.entries()) {
          nowMs += afterMs;
          buffer.push(near ? i & 0xffff : sequence, near ? i * 960 : timestamp, bytes, nowMs);
          for (const { hearAtMs, durationMs } of takeAll(buffer, nowMs)) {
            expect(hearAtMs).toBeGreaterThanOrEqual(nowMs);
            expect(hearAtMs).toBeLessThanOrEqual(nowMs + MOST_DELAY_MS + durationMs);
            expect(hearAtMs).toBeGreaterThanOrEqual(endMs);
            endMs = hearAtMs + durationMs;
          }
          expect(buffer.delayMs).toBeLessThanOrEqual(MOST_DELAY_MS);
        }
      }),
    );
  });
});
