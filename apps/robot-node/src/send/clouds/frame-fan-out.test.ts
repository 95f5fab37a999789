import { expect, it } from 'vitest';
import { RobotCounters } from '../../ground/robot-counters.ts';
import { StageTimer } from '../../ground/stage-timer.ts';
import type { ReadyFrame } from '../../sense/capture/capture-messages.ts';
import type { CaptureBudget } from '../../sense/encode/capture-budget.ts';
import type { FrameAudience } from '../../sense/encode/frame-formats.ts';
import type { CodedFormat, DrawnMost } from '../../sense/encode/plan.ts';
import { FrameFanOut, type FrameTarget } from './frame-fan-out.ts';

class Viewer implements FrameTarget {
  readonly id: string;
  streaming = true;
  display: DrawnMost | null = null;
  readonly #bitsPerSecond: number;
  readonly formats: readonly CodedFormat[];
  sender: FrameTarget['sender'] = null;
  /** The sensor whose frames carry the target's probes. */
  probed = 0;
  frames = 0;
  readonly announced: string[] = [];

  constructor(id: string, cloudBitsPerSecond: number, formats: readonly CodedFormat[]) {
    this.id = id;
    this.#bitsPerSecond = cloudBitsPerSecond;
    this.formats = formats;
  }

  reads(format: CodedFormat): boolean {
    return this.formats.includes(format);
  }
  wants(sensor: number): boolean {
    return sensor === 0;
  }
  probesWith(sensor: number): boolean {
    return sensor === this.probed;
  }
  cloudBitsPerSecond(): number {
    return this.#bitsPerSecond;
  }
  enqueue(): void {
    this.frames++;
  }
  announce({ format }: { format: CodedFormat }): void {
    this.announced.push(format);
  }
}

const BOTH = ['organised', 'unorganised'] as const;

function setUp(viewers: Viewer[], driver: string | null = null) {
  const budgets: CaptureBudget[] = [];
  const capture = {
    onFrame: null as ((frame: ReadyFrame) => void) | null,
    onStream: null as ((stream: { format: CodedFormat; header: Uint8Array }) => void) | null,
    setBudget: (budget: CaptureBudget) => void budgets.push(budget),
    recycle: () => undefined,
    requestLatencyTest: () => undefined,
  };
  const fanOut = new FrameFanOut({
    ...{ sensor: 0, lane: 0 },
    capture,
    targets: () => viewers,
    sendLoop: { run: () => undefined },
    driver: () => driver,
    counters: new RobotCounters(),
    stages: new StageTimer(),
    now: () => 1000,
    mayCode: true,
  });
  fanOut.updateBudget();
  const frame = (audience: FrameAudience) =>
    capture.onFrame?.({
      ...{ type: 'frame', audience, buffer: new ArrayBuffer(0), latencyTest: false, intervalMs: 33 },
      ...{ capturedAtMs: 990, captureMs: 1, captureCpuMs: 1, readyMs: 1000, frameNumber: 1, packets: 1 },
      ...{ points: 10, validPoints: 10, sampleMs: 1, packMs: 1, format: 'points64' },
      rejected: { notFinite: 0, nonPositiveDepth: 0, outOfRange: 0, notDrawn: 0 },
    } as unknown as ReadyFrame);
  const received = (audience: FrameAudience) => {
    const before = viewers.map(({ frames }) => frames);
    frame(audience);
    return viewers.filter(({ frames }, i) => frames > (before[i] as number)).map(({ id }) => id);
  };
  return { budget: budgets.at(-1), capture, received };
}

const coded = (
  format: CodedFormat,
  targetBitsPerSecond: number,
  plainBitsPerSecond: number | null = null,
) => ({
  format,
  targetBitsPerSecond,
  plainBitsPerSecond,
});

it('sends each coded format to those who read it, independently of other formats', () => {
  const { budget } = setUp([new Viewer('a', 5e6, ['organised'])]);
  expect(budget?.coded).toEqual([coded('organised', 5e6)]);
  expect(setUp([new Viewer('a', 5e6, ['unorganised'])]).budget?.coded).toEqual([coded('unorganised', 5e6)]);
  expect(setUp([new Viewer('a', 5e6, BOTH)]).budget?.coded).toEqual([
    coded('organised', 5e6),
    coded('unorganised', 5e6),
  ]);
  expect(setUp([new Viewer('a', 5e6, [])]).budget?.coded).toEqual([]);
});

it('lets the driver decide formats and rate, and sends points64 in parallel to those who cannot read them', () => {
  const viewers = [
    new Viewer('driver', 8e6, ['organised']),
    new Viewer('both', 1e6, BOTH),
    new Viewer('other', 3e6, ['unorganised']),
    new Viewer('plain', 2e6, []),
  ];
  const { budget, received } = setUp(viewers, 'driver');
  expect(budget).toMatchObject({ coded: [coded('organised', 8e6, 2e6)], targetBitsPerSecond: 8e6 });
  expect(received({ readers: 'organised' })).toEqual(['driver', 'both']);
  expect(received({ others: 'organised' })).toEqual(['other', 'plain']);
  expect(received('everyone')).toHaveLength(4);
});

it('wants frames without delay while somebody drives', () => {
  const viewers = [new Viewer('driver', 8e6, BOTH), new Viewer('watcher', 8e6, BOTH)];
  expect(setUp(viewers, 'driver').budget?.prompt).toBe(true);
  expect(setUp(viewers, null).budget?.prompt).toBeUndefined();
});

it('sends points64 to everyone if the driver reads nothing else', () => {
  const { budget } = setUp([new Viewer('driver', 8e6, []), new Viewer('both', 1e6, BOTH)], 'driver');
  expect(budget).toMatchObject({ coded: [], targetBitsPerSecond: 8e6 });
});

it('uses every format that anyone reads if nobody drives, at the slowest path among its readers', () => {
  const viewers = [
    new Viewer('a', 8e6, ['organised']),
    new Viewer('b', 4e6, BOTH),
    new Viewer('c', 1e6, []),
    new Viewer('paused', 1e5, BOTH),
  ];
  viewers[3]!.streaming = false;
  const { budget } = setUp(viewers);
  expect(budget).toMatchObject({
    coded: [coded('organised', 4e6, 1e6), coded('unorganised', 4e6, 1e6)],
    targetBitsPerSecond: 4e6,
  });
});

it('announces a stream to those who read its format', () => {
  const viewers = [new Viewer('a', 1e6, ['organised']), new Viewer('b', 1e6, ['unorganised'])];
  const { capture } = setUp(viewers);
  capture.onStream?.({ format: 'organised', header: new Uint8Array(1) });
  expect(viewers.map(({ announced }) => announced)).toEqual([['organised'], []]);
});

it('enlarges the frames of one sensor for a probe, if a single path decides', () => {
  const probeWish = { clusterId: 4, bytes: 9000 };
  const viewers = ['a', 'b'].map((id) => new Viewer(id, 1e6, []));
  for (const viewer of viewers) viewer.sender = { probeWish, overheadBytes: 0 } as Viewer['sender'];
  expect(setUp(viewers, 'a').budget?.probe).toEqual(probeWish);
  expect(setUp(viewers).budget?.probe).toBeNull();
  for (const viewer of viewers) viewer.probed = 1;
  expect(setUp(viewers, 'a').budget?.probe).toBeNull();
});

it('captures no more than the driver’s computer draws, and without one no more than the fastest watcher’s', () => {
  const viewers = [
    new Viewer('slow', 8e6, BOTH),
    new Viewer('quick', 8e6, BOTH),
    new Viewer('fast', 8e6, BOTH),
  ] as const;
  const [slow, quick, fast] = viewers;
  slow.display = { framesPerSecond: 5, points: 20_000 };
  quick.display = { framesPerSecond: 20, points: 10_000 };
  expect(setUp([slow, quick]).budget?.display).toEqual({ framesPerSecond: 20, points: 20_000 });
  expect(setUp([slow, quick], 'slow').budget?.display).toEqual({ framesPerSecond: 5, points: 20_000 });
  expect(setUp([...viewers], 'slow').budget?.display).toEqual({ framesPerSecond: 5, points: 20_000 });
  // One that draws all that comes.
  expect(fast.display).toBe(null);
  expect(setUp([...viewers]).budget?.display).toBe(undefined);
  expect(setUp([...viewers], 'fast').budget?.display).toBe(undefined);
});
