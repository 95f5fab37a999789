import { LATENCY_TEST_COLOUR } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { BATCH_BYTES, BATCH_PACKETS, Batch } from '../cloud/batch.ts';
import { ImageExtent } from '../cloud/image-extent.ts';
import { splitFrame } from './bridge-frame.ts';
import { parseBridge } from './bridge-settings.ts';

function message(points: number, colour: (i: number) => number): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(points * 8));
  for (let i = 0; i < points; i++) {
    view.setInt16(6 * i, i & 0x7fff, true);
    view.setInt16(6 * i + 2, -(i & 0x7fff), true);
    view.setInt16(6 * i + 4, 1000, true);
    view.setUint16(6 * points + 2 * i, colour(i), true);
  }
  return view.buffer;
}

function split(data: ArrayBuffer, most = 10) {
  const batches: Batch[] = [];
  const next = () => {
    const last = batches.at(-1);
    if (last !== undefined && !last.full) return last;
    if (batches.length === most) return null;
    batches.push(new Batch(new ArrayBuffer(BATCH_BYTES)));
    return batches.at(-1) as Batch;
  };
  return { outcome: splitFrame(data, 5, 1000, new ImageExtent(), { next }), batches };
}

describe('splitFrame', () => {
  it('puts points with their colours into batches, and each packet in its place', () => {
    const total = BATCH_PACKETS * 150 + 400;
    const { outcome, batches } = split(message(total, (i) => (i * 7) & 0xffff));
    expect(outcome).toEqual({ points: total, dropped: 0 });
    expect(batches.map(({ packets, pointCount }) => [packets, pointCount])).toEqual([
      [BATCH_PACKETS, BATCH_PACKETS * 150],
      [3, 400],
    ]);
    const last = batches[1] as Batch;
    expect([last.frameNumber(2), last.frameLength(2), last.sequenceOffset(2), last.pointsOf(2)]).toEqual([
      5,
      total * 8,
      (total - 100) * 8,
      100,
    ]);
    const i = total - 1;
    expect([...last.points.subarray(399 * 4, 400 * 4)]).toEqual([
      i & 0x7fff,
      -(i & 0x7fff),
      1000,
      new Int16Array([(i * 7) & 0xffff])[0],
    ]);
    expect(last.isLatencyTest(0)).toBe(false);
  });

  it('recognises a latency-test frame by its colour', () => {
    expect(split(message(300, () => LATENCY_TEST_COLOUR)).batches[0]?.isLatencyTest(1)).toBe(true);
    expect(
      split(message(300, (i) => LATENCY_TEST_COLOUR + Number(i === 299))).batches[0]?.isLatencyTest(0),
    ).toBe(false);
  });

  it('drops points without a batch, and messages that are not frames', () => {
    expect(
      split(
        message(BATCH_PACKETS * 150 + 400, () => 0),
        1,
      ).outcome,
    ).toEqual({
      points: BATCH_PACKETS * 150,
      dropped: 400,
    });
    expect(split(new ArrayBuffer(0)).outcome).toBeNull();
    expect(split(new ArrayBuffer(12)).outcome).toBeNull();
  });
});

it('parseBridge accepts a host, or a host and three ports', () => {
  expect(parseBridge('ws://localhost')).toEqual({
    control: 'ws://localhost:8085/',
    telemetry: 'ws://localhost:8090/',
    streaming: 'ws://localhost:8095/',
    signaling: null,
  });
  expect(parseBridge('localhost', 'ws://signaling.example:3002')?.signaling).toBe(
    'ws://signaling.example:3002/',
  );
  for (const none of ['', 'signaling.example', 'http://signaling.example'])
    expect(parseBridge('localhost', none)?.signaling).toBeNull();
  expect(parseBridge('wss://robot.example:1,2,3/')?.streaming).toBe('wss://robot.example:3/');
  expect(parseBridge('[::1]')?.control).toBe('ws://[::1]:8085/');
  for (const text of [
    '',
    'http://x',
    'ws://x:8085',
    'ws://x:1,2',
    'ws://x:0,2,3',
    'ws://x:1,2,70000',
    'ws://a b',
  ])
    expect(parseBridge(text)).toBeNull();
});
