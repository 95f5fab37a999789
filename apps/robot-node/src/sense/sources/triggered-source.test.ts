import type { FrameSource } from '@farpoint/cloud-source';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { TriggeredSource } from './triggered-source.ts';

const WISHES = { bitsPerSecond: 0, latencyTest: false };
const ROOM = { points: new Float32Array(0), depth: new Float32Array(0), colour: new Uint32Array(0) };
const MS = 1_000_000n;

describe('TriggeredSource', () => {
  beforeEach(() => void vi.useFakeTimers({ now: 0 }));
  afterEach(() => void vi.useRealTimers());

  function setUp(beganMs: number) {
    const taken: number[] = [];
    let closed = 0;
    const inner = {
      description: { kind: 'sim', width: 4, height: 4, capacity: 16, camera: null, depthMeasure: 'z' },
      state: { twist: null },
      capture: (nowMs: number) => {
        taken.push(nowMs);
        return { capturedAtMs: nowMs };
      },
      close: () => closed++,
    } as unknown as FrameSource;
    const source = new TriggeredSource(inner, 20, () => BigInt(beganMs + Date.now()) * MS);
    const ready: number[] = [];
    source.onReady = () => ready.push(beganMs + Date.now());
    return { source, taken, ready, closed: () => closed };
  }

  it('has no cloud before its first instant', () => {
    const { source, taken } = setUp(1030);
    expect(source.capture(1030, WISHES, ROOM)).toBeNull();
    expect(taken).toEqual([]);
  });

  it('captures at the multiples of its interval, which every other camera of this rate has, too', () => {
    const { source, taken, ready, closed } = setUp(1030);
    source.start();
    vi.advanceTimersByTime(135);
    expect(ready).toEqual([1050, 1100, 1150]);
    // However late it is asked.
    expect(source.capture(1165, WISHES, ROOM)?.capturedAtMs).toBe(1150);
    expect(taken).toEqual([1150]);
    source.close();
    vi.advanceTimersByTime(500);
    expect(ready).toHaveLength(3);
    expect(closed()).toBe(1);
  });

  it('tells its rate, so that the plan takes whole fractions of it', () => {
    expect(setUp(0).source.description).toMatchObject({ kind: 'sim', framesPerSecond: 20 });
  });
});
