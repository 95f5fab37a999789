import type { CaptureWishes, FrameSource, PointFrame } from '@farpoint/cloud-source';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import { type CaptureBudget, NO_BUDGET } from '../encode/capture-budget.ts';
import type { SensorGuard } from '../obstacles/sensor-guard.ts';
import type { CaptureReport } from './capture-messages.ts';
import { CapturePictures } from './capture-pictures.ts';
import { CapturePipeline, workOf } from './pipeline.ts';

const codec = await loadCodecFromDisk();
const POINTS = 2000;
const CODED: CaptureBudget = {
  ...NO_BUDGET,
  targetBitsPerSecond: 20e6,
  overheadBytes: 68,
  streaming: true,
  coded: [{ format: 'unorganised', targetBitsPerSecond: 20e6, plainBitsPerSecond: null }],
};
const PLAIN: CaptureBudget = { ...CODED, coded: [] };
const UNSENT: CaptureBudget = { ...CODED, unsent: true };

/** A pipeline from a LiDAR whose clouds the test makes, on a clock that the test advances. */
function setUp() {
  let nowMs = 1000;
  const asked: CaptureWishes[] = [];
  const reports: CaptureReport[] = [];
  const judged: number[] = [];
  const cloud = (): PointFrame => ({
    form: 'points',
    points: new Float32Array(POINTS * 4).map((_, i) => Math.sin(i) * 5 + 6),
    count: POINTS,
    cameraPose: { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
    capturedAtMs: nowMs - 5,
  });
  let next: () => PointFrame | null = cloud;
  const source = {
    description: {
      kind: 'test',
      width: POINTS,
      height: 1,
      capacity: POINTS,
      camera: null,
      depthMeasure: 'range',
    },
    capture: (_atMs: number, wishes: CaptureWishes) => {
      asked.push(wishes);
      return next();
    },
  } as unknown as FrameSource;
  const guard = { take: () => judged.push(nowMs), lookDown: () => {} } as unknown as SensorGuard;
  const pipeline = new CapturePipeline(
    source,
    codec,
    {
      sensor: 2,
      framesPerSecond: 30,
      plan: 'latency',
      sampling: { lambda: 1, epsilon: 1e-6, nearDistance: 3.85 },
      floorFraction: 0.1,
      mostPoints: POINTS,
    },
    { now: () => nowMs, threadCpu: () => 0 },
    (report) => reports.push(report),
    { pictures: new CapturePictures(source, false), recording: null, guard },
  );
  const sent = () => reports.flatMap((report) => (report.type === 'frame' ? [report] : []));
  return {
    pipeline,
    asked,
    judged,
    sent,
    types: () => reports.map(({ type }) => type),
    capture: (budget = CODED) => pipeline.capture(budget, null),
    give: (made: (usual: PointFrame) => PointFrame | null) => {
      next = () => made(cloud());
    },
    wait: (ms: number) => {
      nowMs += ms;
    },
  };
}

describe('the way of a cloud on the capture thread', () => {
  it('tells a coded stream’s header before its first packets, once', () => {
    const { capture, types } = setUp();
    capture();
    capture();
    expect(types()).toEqual(['stream', 'frame', 'frame']);
  });

  it('sends each frame with its number, its sensor, its capture time and all its packets', () => {
    const { capture, sent, wait } = setUp();
    expect(capture()).toBeGreaterThan(0);
    wait(50);
    capture();
    const [first, second] = sent();
    expect(first).toMatchObject({ inMemoryMs: 1000, readyMs: 1000 });
    expect(first).toMatchObject({ frameNumber: 0, sensor: 2, capturedAtMs: 995, format: 'unorganised' });
    expect(second).toMatchObject({ frameNumber: 1, capturedAtMs: 1045 });
    expect(first?.audience).toEqual({ readers: 'unorganised' });
    expect(first?.points).toBeGreaterThan(POINTS / 2);
    expect(new Uint8Array(first?.buffer as ArrayBuffer).some((byte) => byte !== 0)).toBe(true);
  });

  it('asks the source for nothing while all buffers are away, counts it, and goes on when one returns', () => {
    const { pipeline, capture, sent, asked } = setUp();
    for (let i = 0; i < 4; i++) capture();
    expect(pipeline.hasRoom).toBe(false);
    expect([capture(), asked.length, pipeline.framesWithoutBuffer]).toEqual([null, 4, 1]);
    pipeline.recycle(sent()[0]?.buffer as ArrayBuffer);
    expect(capture()).not.toBeNull();
    expect(sent().map(({ frameNumber }) => frameNumber)).toEqual([0, 1, 2, 3, 4]);
  });

  it('keeps its buffers when there is no cloud, or nobody to send it to', () => {
    const { pipeline, capture, give, sent, judged } = setUp();
    give(() => null);
    for (let i = 0; i < 5; i++) expect(capture()).toBeNull();
    give((usual) => usual);
    for (let i = 0; i < 5; i++) expect(capture(UNSENT)).not.toBeNull();
    expect([sent(), judged.length, pipeline.hasRoom, pipeline.framesWithoutBuffer]).toEqual([[], 1, true, 0]);
  });

  it('asks for a green cloud until one is, and marks that one only', () => {
    const { pipeline, capture, give, asked, sent } = setUp();
    pipeline.requestLatencyTest();
    give((usual) => ({ ...usual, latencyTest: false }));
    capture(PLAIN);
    give((usual) => ({ ...usual, latencyTest: true }));
    capture(PLAIN);
    capture(PLAIN);
    expect(asked.map(({ latencyTest }) => latencyTest)).toEqual([true, true, false]);
    expect(sent().map(({ latencyTest }) => latencyTest)).toEqual([false, true, false]);
  });

  it('enlarges one frame for each cluster of a probe', () => {
    const { capture, sent, pipeline } = setUp();
    const small = { ...PLAIN, targetBitsPerSecond: 0.2e6 };
    const probing = (clusterId: number) =>
      ({ ...small, probe: { clusterId, bytes: 12_000 } }) as CaptureBudget;
    for (const budget of [small, probing(1), probing(1), probing(2)]) {
      capture(budget);
      pipeline.recycle(sent().at(-1)?.buffer as ArrayBuffer);
    }
    const [usual, enlarged, after, again] = sent().map(({ points }) => points) as [
      number,
      number,
      number,
      number,
    ];
    expect(enlarged).toBeGreaterThan(usual);
    expect(after).toBe(usual);
    expect(again).toBe(enlarged);
  });
});

describe('what the obstacle guard judges', () => {
  it('is a cloud every 200 ms while nobody drives, and every 25 ms while somebody does', () => {
    const { pipeline, capture, judged, wait } = setUp();
    const run = () => {
      const before = judged.length;
      for (let i = 0; i < 40; i++) {
        capture(UNSENT);
        wait(10);
      }
      return judged.length - before;
    };
    expect(run()).toBeLessThan(5);
    pipeline.guard(true);
    expect(pipeline.guarding).toBe(true);
    expect(run()).toBeGreaterThanOrEqual(13);
  });

  it('is also a cloud that is captured for it alone, which is not sent and takes no buffer', () => {
    const { pipeline, judged, asked, types } = setUp();
    pipeline.requestLatencyTest();
    for (let i = 0; i < 6; i++) pipeline.look(CODED);
    expect([judged.length, pipeline.hasRoom, types()]).toEqual([6, true, []]);
    expect(asked.every(({ latencyTest }) => !latencyTest)).toBe(true);
  });
});

describe('the time that counts as a frame’s work', () => {
  it('is the clock’s for a source that has its own timing', () => {
    expect(workOf(20, 8, false)).toBe(20);
  });

  it('is processor time for a source that is asked, until most of the time is waiting', () => {
    expect(workOf(10, 8, true)).toBe(8);
    expect(workOf(40, 8, true)).toBe(30);
  });
});
