import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { DriveInput } from './drive-input.ts';
import { type GripLoss, Grips, READING_HOLDS_MS } from './grips.ts';

class Device implements DriveInput {
  readonly name = 'headset';
  readonly wish = { forward: 1, left: 0 };
  held = false;
  readMs: number | null = 0;

  read(held: boolean, nowMs: number): void {
    this.held = held;
    this.readMs = nowMs;
  }
}

const RESUME_MS = 400;

/** @param resumeWithinMs as the robot says; 0: an older robot */
function bench(resumeWithinMs = 0) {
  const device = new Device();
  const grips = new Grips();
  grips.resumeWithinMs = resumeWithinMs;
  const update = (nowMs: number, away = false) => grips.update([device], nowMs, away);
  return { device, grips, update };
}

describe('Grips', () => {
  test('longer than the robot allows, it is lost until it has been opened', () => {
    for (const reads of [true, false]) {
      const { device, grips, update } = bench(RESUME_MS);
      device.read(true, 0);
      update(0);
      if (reads) device.read(true, RESUME_MS + 1);
      expect(update(RESUME_MS + 1)).toBe('late-reading');
      expect([grips.holds(device), grips.isUnread(device)]).toEqual([false, false]);
      device.read(true, RESUME_MS + 20);
      expect([update(RESUME_MS + 20), grips.lossOf(device)]).toEqual([null, 'late-reading']);
      device.read(false, RESUME_MS + 40);
      update(RESUME_MS + 40);
      device.read(true, RESUME_MS + 60);
      expect([update(RESUME_MS + 60), grips.holds(device)]).toEqual([null, true]);
    }
  });

  test('hands that are away, and a path that is lost, need no gap', () => {
    const { device, grips, update } = bench(RESUME_MS);
    device.read(true, 0);
    update(0);
    update(150);
    grips.lose([device], 'path-lost');
    // The first loss is the one that is told.
    grips.lose([device], 'let-go');
    device.read(true, 200);
    update(200);
    expect(grips.lossOf(device)).toBe('path-lost');
  });

  test('to a robot that does not say so, a grip that is not read is lost, and holds again only after a reading has found it open', () => {
    const { device, grips, update } = bench();
    device.read(true, 0);
    expect([update(0), update(READING_HOLDS_MS)]).toEqual([null, null]);
    expect(grips.holds(device)).toBe(true);
    expect(update(READING_HOLDS_MS + 1)).toBe('late-reading');
    expect([grips.holds(device), grips.lossOf(device)]).toEqual([false, 'late-reading']);
    device.read(true, 200);
    expect([update(200), grips.holds(device)]).toEqual([null, false]);
    device.read(false, 210);
    update(210);
    device.read(true, 220);
    expect([update(220), grips.holds(device)]).toEqual([null, true]);
  });

  test('a grip that is held while the hands are away does not drive when they return', () => {
    const { device, grips, update } = bench();
    device.read(true, 0);
    expect(update(0, true)).toBe(null);
    device.read(true, 25);
    update(25);
    expect(grips.lossOf(device)).toBe('hands-away');
  });

  test('an input that lets go by itself is never late', () => {
    const { device, grips, update } = bench();
    device.readMs = null;
    device.held = true;
    update(0);
    update(10_000);
    expect(grips.holds(device)).toBe(true);
    grips.lose([device], 'path-lost');
    update(10_025);
    expect(grips.lossOf(device)).toBe('path-lost');
  });

  test.each([0, RESUME_MS])(
    'for any readings, ticks and losses: what holds was read within the time, and opened since its loss (%i ms)',
    (resumeMs) => {
      const longestMs = Math.max(READING_HOLDS_MS, resumeMs);
      const step = fc.record({
        ms: fc.nat(longestMs + 60),
        reading: fc.option(fc.record({ held: fc.boolean(), ageMs: fc.nat(longestMs + 50) })),
        away: fc.boolean(),
        loss: fc.option(fc.constantFrom<GripLoss>('path-lost', 'let-go'), { freq: 8 }),
      });
      fc.assert(
        fc.property(fc.array(step, { maxLength: 80 }), (steps) => {
          const { device, grips, update } = bench(resumeMs);
          let nowMs = 0;
          let mustOpen = false;
          for (const { ms, reading, away, loss } of steps) {
            nowMs += ms;
            const { held: wasHeld, readMs: before } = device;
            if (reading !== null) device.read(reading.held, Math.max(before ?? 0, nowMs - reading.ageMs));
            const ageMs = nowMs - (device.readMs ?? 0);
            const gapMs = (device.readMs ?? 0) - (before ?? 0);
            if (loss !== null) grips.lose([device], loss);
            update(nowMs, away);
            const isFresh = ageMs <= READING_HOLDS_MS;
            if (!device.held) mustOpen = (mustOpen || (loss !== null && wasHeld)) && !isFresh;
            else if (away || loss !== null || ageMs > longestMs || (wasHeld && gapMs > longestMs))
              mustOpen = true;
            expect(grips.holds(device)).toBe(device.held && !mustOpen);
            expect(grips.isUnread(device)).toBe(device.held && !mustOpen && !isFresh);
          }
        }),
        { seed: 19 },
      );
    },
  );
});
