import { expect, it } from 'vitest';
import { RobotCounters } from '../../ground/robot-counters.ts';
import { StageTimer } from '../../ground/stage-timer.ts';
import type { ReadyFrame } from '../../sense/capture/capture-messages.ts';
import type { FrameAudience } from '../../sense/encode/frame-formats.ts';
import type { CodedFormat } from '../../sense/encode/plan.ts';
import { type FrameTarget, SendPipeline } from './pipeline.ts';

/** An operator. @param wanted the number of the sensor whose clouds it wants */
function viewer(id: string, formats: readonly CodedFormat[], wanted = 0) {
  const got = { frames: 0, headers: [] as string[] };
  const target = {
    id,
    wants: (sensor: number) => sensor === wanted,
    reads: (format: CodedFormat) => formats.includes(format),
    enqueue: () => void got.frames++,
    announce: ({ format }: { format: CodedFormat }) => void got.headers.push(format),
  };
  return { got, target: target as unknown as FrameTarget };
}

function setUp(viewers: readonly ReturnType<typeof viewer>[]) {
  const capture = {
    onFrame: null as ((frame: ReadyFrame) => void) | null,
    onStream: null as ((stream: { format: CodedFormat; header: Uint8Array }) => void) | null,
    recycle: () => undefined,
    requestLatencyTest: () => undefined,
  };
  const counters = new RobotCounters();
  const pipeline = new SendPipeline({
    sensor: 0,
    lane: 0,
    capture,
    targets: () => viewers.map(({ target }) => target),
    sendLoop: { run: () => undefined },
    overheadBytes: () => 0,
    counters,
    stages: new StageTimer(),
    now: () => 1000,
  });
  const frame = (audience: FrameAudience, capturedAtMs = 990) => {
    const before = viewers.map(({ got }) => got.frames);
    capture.onFrame?.({
      ...{ type: 'frame', audience, buffer: new ArrayBuffer(0), latencyTest: false, intervalMs: 33 },
      ...{
        capturedAtMs,
        inMemoryMs: capturedAtMs,
        captureMs: 1,
        captureCpuMs: 1,
        readyMs: 1000,
        frameNumber: 1,
        packets: 1,
      },
      ...{ points: 10, validPoints: 10, sampleMs: 1, packMs: 1, format: 'points64' },
      rejected: { notFinite: 0, nonPositiveDepth: 0, outOfRange: 0, notDrawn: 0 },
    } as unknown as ReadyFrame);
    return viewers.filter(({ got }, i) => got.frames > (before[i] as number)).map(({ target }) => target.id);
  };
  return { pipeline, capture, counters, frame };
}

it('a frame goes to those who want its sensor, and read its format', () => {
  const { frame } = setUp([
    viewer('one', ['organised']),
    viewer('both', ['organised', 'unorganised']),
    viewer('none', []),
    viewer('elsewhere', ['organised'], 1),
  ]);
  expect(frame({ readers: 'organised' })).toEqual(['one', 'both']);
  expect(frame({ others: 'organised' })).toEqual(['none']);
  expect(frame('everyone')).toEqual(['one', 'both', 'none']);
});

it('a frame that is too old goes to nobody, and is counted', () => {
  const { frame, counters } = setUp([viewer('a', [])]);
  expect(frame('everyone', 749)).toEqual([]);
  expect(frame('everyone', 750)).toEqual(['a']);
  expect(counters.framesStale).toBe(1);
});

it('announces a stream to those who read its format, also to who comes later', () => {
  const viewers = [viewer('a', ['organised']), viewer('b', ['unorganised'])];
  const { capture, pipeline } = setUp(viewers);
  capture.onStream?.({ format: 'organised', header: new Uint8Array(1) });
  expect(viewers.map(({ got }) => got.headers)).toEqual([['organised'], []]);
  const late = viewer('late', ['organised']);
  pipeline.announceTo(late.target);
  expect(late.got.headers).toEqual(['organised']);
});
