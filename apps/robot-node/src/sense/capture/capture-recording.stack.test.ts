import { join } from 'node:path';
import { openRecording, SessionRecorder } from '@farpoint/recording';
import { cloudMessage, mcapOf, writeFile } from '@farpoint/recording/testing';
import type { TopicTable } from '@farpoint/ros';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import * as z from 'zod';
import { NO_BUDGET } from '../encode/capture-budget.ts';
import { CODED_FORMATS } from '../encode/plan.ts';
import type { SourceOptions } from '../sources/open-source.ts';
import { Capture } from './capture.ts';
import type { CaptureOptions, ReadyFrame } from './capture-messages.ts';

const folder = useFolder();

const cloudSchema = z.object({
  header: z.object({ stamp: z.object({ sec: z.number(), nanosec: z.number() }) }),
  data: z.instanceof(Uint8Array),
});
const OPTIONS: Omit<CaptureOptions, 'source'> = {
  framesPerSecond: 20,
  plan: 'paper',
  sampling: { lambda: 0, epsilon: 1e-6, nearDistance: 3.85 },
  floorFraction: 0.1,
  mostPoints: 1_000_000,
  sensor: 0,
};

interface Recorded {
  points: number;
  /** Smallest and largest x, y and z of the valid points. */
  least: number[];
  most: number[];
  /** When it was captured, ms. */
  stampMs: number;
}

function measure(message: unknown): Recorded {
  const { header, data } = cloudSchema.parse(message);
  const words = new Float32Array(data.slice().buffer);
  const [least, most] = [[0, 0, 0].fill(Number.POSITIVE_INFINITY), [0, 0, 0].fill(Number.NEGATIVE_INFINITY)];
  let points = 0;
  for (let i = 0; i < words.length; i += 4) {
    if (!Number.isFinite(words[i + 2])) continue;
    points++;
    for (let axis = 0; axis < 3; axis++) {
      least[axis] = Math.min(least[axis] as number, words[i + axis] as number);
      most[axis] = Math.max(most[axis] as number, words[i + axis] as number);
    }
  }
  return { points, least, most, stampMs: header.stamp.sec * 1000 + header.stamp.nanosec / 1e6 };
}

/** Captures `count` frames while recording. @returns them and what was recorded of them */
async function recordFrames(source: SourceOptions, coded: boolean, count: number) {
  const path = join(folder, `${source.kind}-${coded}.mcap`);
  const recorder = await SessionRecorder.open({ path, compression: 'none', robotId: 'test', epochNs: 0n });
  const capture = await Capture.start(
    { source, ...OPTIONS },
    { clouds: recorder.clouds, livePerSecond: 0, perSecond: { captured: 1000, sent: 1000 } },
  );
  const frames: ReadyFrame[] = [];
  await new Promise<void>((resolve) => {
    capture.onFrame = (frame) => {
      frames.push({ ...frame });
      capture.recycle(frame.buffer);
      if (frames.length === count) resolve();
    };
    capture.setBudget({
      ...NO_BUDGET,
      targetBitsPerSecond: 200e6,
      overheadBytes: 68,
      streaming: true,
      coded: coded
        ? CODED_FORMATS.map((format) => ({ format, targetBitsPerSecond: 200e6, plainBitsPerSecond: null }))
        : [],
    });
  });
  await capture.close();
  await recorder.close();
  expect(recorder.faults).toBe(0);
  const recording = await openRecording(path);
  const [captured, sent]: [Recorded[], Recorded[]] = [[], []];
  for await (const { topic, data } of recording.messages(['/farpoint/captured', '/farpoint/sent'], 0n)) {
    (topic.name === '/farpoint/sent' ? sent : captured).push(measure(topic.decode(data)));
  }
  await recording.close();
  return { frames, captured, sent };
}

describe('capture thread that is recorded', { timeout: 30_000 }, () => {
  const lidar = join(folder, 'lidar.mcap');

  it.each([
    ['points64', { kind: 'sim', seed: 1, size: 64 } as const, false, 0.002],
    ['organised', { kind: 'sim', seed: 1, size: 240 } as const, true, 0.05],
    [
      'unorganised',
      {
        kind: 'recording',
        path: lidar,
        topic: null,
        rate: 1,
        fromS: 0,
        atEnd: 'repeat',
        axes: 'auto',
        topics: [] as TopicTable,
      } as const,
      true,
      0.011,
    ],
  ])(
    '%s: what was sent is what was captured, but for the format’s step',
    async (format, source, coded, step) => {
      if (source.kind === 'recording') {
        writeFile(lidar, await mcapOf(20, (k) => cloudMessage(k, 20 + k)));
      }
      const { frames, captured, sent } = await recordFrames(source, coded, 6);
      expect(frames.every((frame) => frame.format === format)).toBe(true);
      // Where a machine stalls, the recorder drops clouds, and says so.
      let whole = 0;
      for (const asSent of sent) {
        const of = (all: readonly Recorded[]) => all.find(({ stampMs }) => stampMs === asSent.stampMs);
        const frame = frames.find(({ capturedAtMs }) => Math.abs(capturedAtMs - asSent.stampMs) < 0.01);
        const asCaptured = of(captured);
        if (frame === undefined || asCaptured === undefined) continue;
        expect(asSent.points).toBe(frame.points);
        // All points were sent, so the clouds have the same bounds.
        if (frame.points !== asCaptured.points) continue;
        whole++;
        for (const end of ['least', 'most'] as const) {
          asSent[end].forEach((sentMetres, axis) => {
            const metres = asCaptured[end][axis] as number;
            // The step of the organised format grows with the distance.
            expect(Math.abs(sentMetres - metres)).toBeLessThan(step + (coded ? 0.1 * Math.abs(metres) : 0));
          });
        }
      }
      expect(whole).toBeGreaterThan(0);
    },
  );
});
