import { describe, expect, it } from 'vitest';
import { ReportedLimit } from './reported-limit.ts';

const BLOCK_BITS = 1200 * 8;
const FRAME_MS = 100;

/** A limit whose frames are sent at 10 a second; the wire adds nothing to the points. */
function setUp() {
  const limit = new ReportedLimit(1200);
  let nowMs = 0;
  const send = (packets: number, frames: number, report: number | null = packets * BLOCK_BITS * 10) => {
    for (let i = 0; i < frames; i++) {
      limit.sent(packets, nowMs);
      nowMs += FRAME_MS;
      if (report !== null) limit.reported(report);
    }
    return limit.bitsPerSecond;
  };
  const wait = (ms: number) => {
    nowMs += ms;
  };
  return { limit, send, wait };
}

describe('ReportedLimit', () => {
  it('is none while as much arrives as is sent, whatever that is', () => {
    const { send } = setUp();
    for (const packets of [60, 20, 1, 5, 60]) expect(send(packets, 40)).toBe(Number.POSITIVE_INFINITY);
  });

  it('is none while frames differ in size and reports jitter', () => {
    const { limit, send } = setUp();
    for (let i = 0; i < 400; i++) {
      const jitter = [0.9, 1.1, 1, 0.95, 1.05][i % 5] as number;
      const packets = 20 + ((i * 7) % 30);
      send(packets, 1, packets * BLOCK_BITS * 10 * jitter);
      expect(limit.bitsPerSecond).toBe(Number.POSITIVE_INFINITY);
    }
  });

  it('is none where reports are late and the rate rises at once', () => {
    const { limit, send } = setUp();
    const lag = 12;
    for (let i = 0; i < 100; i++) {
      const before = i - lag < 50 ? 5 : 60;
      send(i < 50 ? 5 : 60, 1, before * BLOCK_BITS * 10);
      expect(limit.bitsPerSecond).toBe(Number.POSITIVE_INFINITY);
    }
  });

  it('is the largest of the last 16 reports, in bits on the wire, where these fall short', () => {
    const limit = new ReportedLimit(1280);
    for (let frame = 0; frame < 40; frame++) limit.sent(100, frame * FRAME_MS);
    for (const report of [1, 2, 3]) limit.reported(report);
    // The first three may cover the connection's own start.
    expect(limit.bitsPerSecond).toBe(Number.POSITIVE_INFINITY);
    limit.reported(120_000);
    expect(limit.bitsPerSecond).toBe(128_000);
    for (let i = 0; i < 15; i++) limit.reported(60_000);
    expect(limit.bitsPerSecond).toBe(128_000);
    limit.reported(60_000);
    expect(limit.bitsPerSecond).toBe(64_000);
  });

  it('applies also if the reports came before it was known how much is sent', () => {
    const { limit, send } = setUp();
    for (let i = 0; i < 16; i++) limit.reported(400_000);
    expect(limit.bitsPerSecond).toBe(Number.POSITIVE_INFINITY);
    expect(send(60, 5, null)).toBe(400_000);
  });

  it('rises again, and ends, when the path carries what is sent', () => {
    const { limit, send } = setUp();
    expect(send(60, 40, 500_000)).toBe(500_000);
    let frames = 0;
    while (limit.bitsPerSecond < 5_760_000) {
      const packets = Math.floor(Math.min(limit.bitsPerSecond, 5_760_000) / BLOCK_BITS / 10);
      send(packets, 1);
      frames++;
    }
    expect(frames).toBeLessThan(200);
    expect(send(60, 100)).toBe(Number.POSITIVE_INFINITY);
  });

  it('keeps a limit over a pause in sending', () => {
    const { send, wait } = setUp();
    send(60, 40, 500_000);
    wait(5000);
    expect(send(60, 1, 500_000)).toBe(510_000);
  });
});
