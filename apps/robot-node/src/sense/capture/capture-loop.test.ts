import type { FrameSource } from '@farpoint/cloud-source';
import { describe, expect, it } from 'vitest';
import { NO_BUDGET } from '../encode/capture-budget.ts';
import { CaptureLoop, type LoopFrames } from './capture-loop.ts';
import type { CaptureReport } from './capture-messages.ts';

const STREAMING = { ...NO_BUDGET, type: 'budget', streaming: true } as const;
const PAUSED = { ...NO_BUDGET, type: 'budget' } as const;

/** A loop over a source and frames that only record the calls to them, on a clock that the test advances. */
function setUp(ownRhythm = false) {
  let nowMs = 1000;
  const reports: CaptureReport[] = [];
  const captures: number[] = [];
  const skips: number[] = [];
  const looks: number[] = [];
  const rates: (number | null)[] = [];
  let guarding = false;
  let intervalMs: number | null = 50;
  let hasRoom = true;
  const source = {
    state: { twist: null },
    ...(ownRhythm ? { onReady: null, skip: (atMs: number) => skips.push(atMs) } : {}),
    onFault: null,
    close: () => reports.push({ type: 'fault', detail: 'source closed' }),
  } as unknown as FrameSource;
  const frames: LoopFrames = {
    framesWithoutBuffer: 3,
    get hasRoom() {
      return hasRoom;
    },
    wishes: () => ({ bitsPerSecond: 0, latencyTest: false }),
    capture: (_budget, measuredFramesPerSecond) => {
      rates.push(measuredFramesPerSecond);
      if (intervalMs !== null) captures.push(nowMs);
      return intervalMs;
    },
    recycle: () => undefined,
    guard: (wanted) => {
      guarding = wanted;
    },
    get guarding() {
      return guarding;
    },
    look: () => looks.push(nowMs),
    requestLatencyTest: () => undefined,
    close: () => undefined,
  };
  const send = (report: CaptureReport) => reports.push(report);
  const loop = new CaptureLoop(source, frames, { framesPerSecond: 20, now: () => nowMs, send });
  return {
    ...{ loop, source, reports, captures, skips, looks, rates },
    states: () => reports.filter(({ type }) => type === 'state').length,
    plan: (ms: number | null) => {
      intervalMs = ms;
    },
    fillBuffers: () => {
      hasRoom = false;
    },
    ready: (ms = 0) => {
      nowMs += ms;
      source.onReady?.();
    },
    wait: (ms: number) => {
      nowMs += ms;
    },
    /** Captures as the loop's owner does, until `ms` have passed. */
    run: (ms: number) => {
      const until = nowMs + ms;
      while (nowMs < until) nowMs = Math.min(until, nowMs + Math.max(loop.captureDue(), 1));
    },
  };
}

describe('CaptureLoop for the obstacle guard', () => {
  it('asks for 20 clouds a second while somebody drives and nobody watches', () => {
    const { loop, run, captures, looks } = setUp();
    loop.onRequest(PAUSED);
    run(200);
    expect(looks).toEqual([]);
    loop.onRequest({ type: 'guard', wanted: true });
    run(200);
    expect(looks).toEqual([1200, 1250, 1300, 1350]);
    loop.onRequest({ type: 'guard', wanted: false });
    run(200);
    expect([looks.length, captures]).toEqual([4, []]);
  });

  it('asks for none besides those that are sent at such a rate, and for more where fewer are sent', () => {
    const { loop, run, plan, captures, looks } = setUp();
    loop.onRequest({ type: 'guard', wanted: true });
    loop.onRequest(STREAMING);
    run(200);
    expect([captures.length, looks]).toEqual([4, []]);
    plan(100);
    run(400);
    expect([captures.length, looks.length]).toEqual([8, 4]);
  });

  it('takes the clouds of a source with its own timing, and skips those that come too often', () => {
    const { loop, ready, looks, skips } = setUp(true);
    loop.onRequest({ type: 'guard', wanted: true });
    for (let i = 0; i < 6; i++) ready(20);
    // The first waited for a listener.
    expect(looks).toEqual([1000, 1060, 1120]);
    expect(skips).toEqual([1020, 1040, 1080, 1100]);
  });
});

describe('CaptureLoop over a source that can be asked at any time', () => {
  it('captures nothing while nobody watches, then at the rate of the plan', () => {
    const { loop, run, captures } = setUp();
    loop.onRequest(PAUSED);
    run(200);
    expect(captures).toEqual([]);
    loop.onRequest(STREAMING);
    run(200);
    expect(captures).toEqual([1200, 1250, 1300, 1350]);
  });

  it('does not make up for frames missed in a stall', () => {
    const { loop, run, wait, captures } = setUp();
    loop.onRequest(STREAMING);
    run(60);
    wait(500);
    run(60);
    expect(captures).toEqual([1000, 1050, 1560, 1610]);
  });

  it('asks a source that had no cloud again at the rate it was opened with', () => {
    const { loop, run, plan, captures } = setUp();
    loop.onRequest(STREAMING);
    plan(null);
    run(120);
    plan(10);
    run(55);
    expect(captures).toEqual([1150, 1160, 1170]);
  });
});

describe('CaptureLoop over a source with its own timing', () => {
  it('takes each cloud that the plan has room for and skips the others', () => {
    const { loop, ready, captures, skips } = setUp(true);
    loop.onRequest(STREAMING);
    expect(captures).toEqual([1000]);
    for (let i = 0; i < 6; i++) ready(25);
    expect(captures).toEqual([1000, 1050, 1100, 1150]);
    expect(skips).toEqual([1025, 1075, 1125]);
  });

  it('keeps a cloud until somebody watches, but not for long', () => {
    const { loop, ready, wait, captures, skips } = setUp(true);
    ready(500);
    wait(40);
    loop.onRequest(STREAMING);
    expect(captures).toEqual([1540]);
    loop.onRequest(PAUSED);
    ready(500);
    wait(51);
    loop.onRequest(STREAMING);
    expect([captures, skips]).toEqual([[1540], [2091]]);
  });

  it('is called again when its next report is due, not a fraction of a millisecond before', () => {
    const { loop, wait } = setUp(true);
    expect(loop.captureDue()).toBe(20);
    wait(0.3);
    expect(loop.captureDue()).toBe(20);
    wait(19);
    expect(loop.captureDue()).toBe(1);
  });

  it('skips a cloud if all buffers are in use', () => {
    const { loop, ready, fillBuffers, captures, skips } = setUp(true);
    loop.onRequest(STREAMING);
    fillBuffers();
    ready(100);
    expect([captures, skips]).toEqual([[1000], [1100]]);
  });
});

describe('CaptureLoop', () => {
  it('reports a changed state at once, and an unchanged one ten times a second', () => {
    const { source, run, states } = setUp();
    run(500);
    expect(states()).toBe(5);
    Object.assign(source, { state: { twist: null } });
    run(20);
    expect(states()).toBe(6);
  });

  it('reports a repeated fault once, until there is a cloud again', () => {
    const { loop, source, run, plan, reports } = setUp();
    const faults = () => reports.flatMap((report) => (report.type === 'fault' ? [report.detail] : []));
    for (let i = 0; i < 3; i++) source.onFault?.(new Error('no producer'));
    expect(faults()).toEqual(['no producer']);
    plan(50);
    loop.onRequest(STREAMING);
    run(10);
    source.onFault?.(new Error('no producer'));
    expect(faults()).toEqual(['no producer', 'no producer']);
  });

  it('captures nothing after it is closed', () => {
    const { loop, ready, captures, reports } = setUp(true);
    loop.onRequest(STREAMING);
    loop.onRequest({ type: 'close' });
    ready(100);
    expect(loop.closed).toBe(true);
    expect(captures).toEqual([1000]);
    expect(reports.slice(-2).map(({ type }) => type)).toEqual(['fault', 'closed']);
  });
});

describe('CaptureLoop and the source’s real rate', () => {
  it('tells how often clouds come, whether or not they are taken', () => {
    const { loop, ready, rates } = setUp(true);
    loop.onRequest(STREAMING);
    // Planned are 20 a second. 40 come, then 10.
    for (let i = 0; i < 9; i++) ready(25);
    expect(rates.at(-1)).toBeCloseTo(40);
    for (let i = 0; i < 9; i++) ready(100);
    expect(rates.at(-1)).toBeCloseTo(10);
  });

  it('knows no rate of a source that is asked: that comes when it is asked', () => {
    const { loop, run, rates } = setUp();
    loop.onRequest(STREAMING);
    run(400);
    expect(new Set(rates)).toEqual(new Set([null]));
  });
});
