import { describe, expect, test } from 'vitest';
import { Heartbeat } from './heartbeat.ts';

const OPTIONS = { firstMs: 30_000, silenceMs: 5000, checkMs: 500 };

/** Checks every 500 ms. @returns the first time at which it is lost, or `null` */
function lostAt(heartbeat: Heartbeat, fromMs: number, untilMs: number, beats: (ms: number) => boolean) {
  for (let now = fromMs; now <= untilMs; now += 500) {
    if (beats(now)) heartbeat.beat();
    if (heartbeat.isLost(now)) return now;
  }
  return null;
}

describe('Heartbeat', () => {
  test('is lost after the silence that is allowed, to within one check', () => {
    const heartbeat = new Heartbeat(OPTIONS, 0);
    expect(lostAt(heartbeat, 0, 60_000, (now) => now <= 20_000)).toBe(25_000);
    expect(heartbeat.silentMs).toBe(5500);
  });

  test('may take longer to begin', () => {
    expect(lostAt(new Heartbeat(OPTIONS, 0), 0, 60_000, () => false)).toBe(30_500);
    expect(lostAt(new Heartbeat(OPTIONS, 0), 0, 60_000, (now) => now === 29_000)).toBe(34_000);
  });

  test('is never lost while there are signs of life, however rare', () => {
    expect(lostAt(new Heartbeat(OPTIONS, 0), 0, 600_000, (now) => now % 5000 === 0)).toBeNull();
  });

  test('time in which nobody checks does not count', () => {
    const heartbeat = new Heartbeat(OPTIONS, 0);
    heartbeat.beat();
    expect(heartbeat.isLost(60_000)).toBe(false);
    expect(heartbeat.isLost(3_600_000)).toBe(false);
    expect(heartbeat.silentMs).toBe(2000);
    // A clock that goes back is no time, either.
    expect(heartbeat.isLost(0)).toBe(false);
    expect(heartbeat.silentMs).toBe(2000);
  });
});
