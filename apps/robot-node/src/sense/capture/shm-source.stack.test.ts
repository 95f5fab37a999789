/** Producers in shared memory, read by the real capture thread. */
import { rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { CaptureRoom } from '@farpoint/cloud-source';
import { emptyPlacement, emptyPointPacketHeader, type Pose, readCloudPayload } from '@farpoint/protocol';
import { testFolder } from '@farpoint/service/testing/folder';
import {
  CloudProducer,
  type FrameHeader,
  isAvailable,
  ReferenceFrameProducer,
  referenceFiles,
} from '@farpoint/shared-memory';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { monotonicMs } from '../../ground/clock.ts';
import { NO_BUDGET } from '../encode/capture-budget.ts';
import { slotPayloadBytes } from '../encode/packetiser.ts';
import { ReferenceShmSource } from '../sources/reference-shm-source.ts';
import { Capture } from './capture.ts';
import type { ReadyFrame } from './capture-messages.ts';

let folder: string;
beforeEach(() => {
  folder = testFolder();
});

/** Repeats until the test ends, at the latest. */
function every(ms: number, produce: () => void): NodeJS.Timeout {
  const timer = setInterval(produce, ms);
  onTestFinished(() => clearInterval(timer));
  return timer;
}

function keep<T extends { close(): unknown }>(made: T): T {
  onTestFinished(async () => void (await made.close()));
  return made;
}

async function start(layout: 'farpoint' | 'reference', waitMs = 10_000): Promise<Capture> {
  const capture = await Capture.start({
    source: { kind: 'shm', layout, folder, waitMs },
    framesPerSecond: 30,
    plan: 'paper',
    sampling: { lambda: 1, epsilon: 1e-6, nearDistance: 3.85 },
    floorFraction: 0.1,
    mostPoints: 1_000_000,
    sensor: 0,
  });
  return keep(capture);
}

const BUDGET = { ...NO_BUDGET, targetBitsPerSecond: 123_000_000, overheadBytes: 68, streaming: true };

/** Calls `produce` repeatedly until a frame matches; ignores earlier frames. */
async function frameWhere(
  capture: Capture,
  produce: () => void,
  is: (frame: ReadyFrame, mm: number[]) => boolean,
): Promise<ReadyFrame> {
  const timer = every(5, produce);
  try {
    return await new Promise((resolve) => {
      capture.onFrame = (frame) => {
        const copy = { ...frame, buffer: frame.buffer.slice(0) };
        capture.recycle(frame.buffer);
        if (is(copy, firstPoint(copy))) resolve(copy);
      };
    });
  } finally {
    clearInterval(timer);
    capture.onFrame = null;
  }
}

function firstPoint({ buffer }: ReadyFrame): number[] {
  return [...new Int16Array(buffer, 16, 3)];
}

function placementOf(frame: ReadyFrame) {
  const placement = emptyPlacement();
  const view = new DataView(frame.buffer, 0, slotPayloadBytes(new Uint8Array(frame.buffer), 0));
  expect(readCloudPayload(view, emptyPointPacketHeader(), placement)).toBeNull();
  return placement;
}

function cloud(z: number, points: number): Float32Array {
  return Float32Array.from({ length: points * 4 }, (_, i) => (i % 4 === 2 ? z : i % 4 === 3 ? 0 : 0.5));
}

/** One block of the reference system's packed points, all at (1, 2, depth) mm. */
function packed(depth: number, colour: number): Uint8Array {
  const block = new DataView(new ArrayBuffer(1200));
  for (let i = 0; i < 150; i++) {
    block.setInt16(i * 6, 1, true);
    block.setInt16(i * 6 + 2, 2, true);
    block.setInt16(i * 6 + 4, depth, true);
    block.setUint16(900 + i * 2, colour, true);
  }
  return new Uint8Array(block.buffer);
}

const GRID: Omit<FrameHeader, 'depthUnit'> = {
  ...{ capturedAtMs: null, width: 20, height: 15, pose: null, lens: null, latencyTest: false },
};

describe.skipIf(!isAvailable())(
  'sources in shared memory (need the addon: pnpm build:native)',
  { timeout: 30_000 },
  () => {
    it('farpoint: turns frames with grid, pose and capture time into packets', async () => {
      const producer = keep(
        new CloudProducer({ folder, format: 'points', maxPoints: 300, framesPerSecond: 30 }),
      );
      producer.publish({ points: cloud(1, 300) }, GRID);
      const capture = await start('farpoint');
      expect(capture.description).toMatchObject({
        width: 20,
        height: 15,
        capacity: 300,
        framesPerSecond: 30,
      });
      capture.setBudget(BUDGET);
      const pose: Pose = { position: { x: 4, y: 5, z: 6 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
      let stamp = 0;
      const produce = () => {
        stamp = monotonicMs() - 7;
        producer.publish({ points: cloud(2, 300) }, { ...GRID, capturedAtMs: stamp, pose });
      };
      const frame = await frameWhere(capture, produce, (_, [, , z]) => z === 2000);
      expect(frame.points).toBe(300);
      expect(placementOf(frame).pose.position).toEqual({ x: 4, y: 5, z: 6 });
      expect(frame.capturedAtMs).toBeLessThanOrEqual(stamp);
      expect(frame.readyMs - frame.capturedAtMs).toBeGreaterThanOrEqual(7);
      const state = await new Promise<{ x: number }>((resolve) => {
        capture.onState = ({ pose: { position } }) => resolve(position);
      });
      expect(state.x).not.toBe(0);
    });

    it('farpoint: turns a camera’s grid into the points of images', async () => {
      const lens = { fx: 10, fy: 10, cx: 9.5, cy: 7 };
      const producer = keep(new CloudProducer({ folder, format: 'depth16', maxPoints: 300 }));
      const content = { depth: new Uint16Array(300).fill(2000), colours: new Uint8Array(1200) };
      const publish = () => producer.publish(content, { ...GRID, lens, depthUnit: 0.001 });
      publish();
      const capture = await start('farpoint');
      expect(capture.description).toMatchObject({ width: 20, height: 15, camera: lens });
      capture.setBudget(BUDGET);
      const frame = await frameWhere(capture, publish, () => true);
      expect(frame.points).toBe(300);
      expect(firstPoint(frame)).toEqual([-1900, -1400, 2000]);
      const failure = new Promise<Error>((resolve) => {
        capture.onFailure = resolve;
      });
      const other = { ...GRID, lens: { ...lens, fx: 11 }, depthUnit: 0.001 };
      const timer = every(5, () => producer.publish(content, other));
      expect((await failure).message).toContain('camera');
      clearInterval(timer);
    });

    it('farpoint: recovers when another producer takes over, and reports the fault meanwhile', async () => {
      const first = keep(new CloudProducer({ folder, format: 'points', maxPoints: 300 }));
      first.publish({ points: cloud(1, 300) }, GRID);
      const capture = await start('farpoint');
      capture.setBudget(BUDGET);
      first.close();
      const fault = new Promise<string>((resolve) => {
        capture.onFault = resolve;
      });
      rmSync(join(folder, 'farpoint_cloud'));
      expect(await fault).toContain(join(folder, 'farpoint_cloud'));
      const second = keep(new CloudProducer({ folder, format: 'points', maxPoints: 150 }));
      const small = { ...GRID, width: 150, height: 1 };
      const produce = () => second.publish({ points: cloud(3, 150) }, small);
      const frame = await frameWhere(capture, produce, (_, [, , z]) => z === 3000);
      expect(frame.points).toBe(150);
      expect(capture.faults).toBeGreaterThanOrEqual(1);
    });

    it('farpoint: ends with a reason if another producer’s frames are too large', async () => {
      const first = keep(new CloudProducer({ folder, format: 'points', maxPoints: 100 }));
      first.publish({ points: cloud(1, 100) }, { ...GRID, width: 100, height: 1 });
      const capture = await start('farpoint');
      capture.setBudget(BUDGET);
      const failure = new Promise<Error>((resolve) => {
        capture.onFailure = resolve;
      });
      first.close();
      const second = keep(new CloudProducer({ folder, format: 'points', maxPoints: 300 }));
      second.publish({ points: cloud(1, 300) }, GRID);
      expect((await failure).message).toContain('room for 100');
    });

    it.each(['reference', 'farpoint'] as const)(
      '%s: goes on after a frame that existed before it started',
      async (layout) => {
        const mine = layout === 'reference' ? keep(new ReferenceFrameProducer(folder)) : null;
        const ours =
          layout === 'farpoint'
            ? keep(new CloudProducer({ folder, format: 'points', maxPoints: 300 }))
            : null;
        const produce = () => {
          mine?.publish(packed(3, 0));
          ours?.publish({ points: cloud(0.003, 300) }, GRID);
        };
        produce();
        const opening = start(layout);
        const timer = every(1, produce);
        const capture = await opening;
        clearInterval(timer);
        capture.setBudget(BUDGET);
        const frame = await frameWhere(capture, produce, () => true);
        expect(firstPoint(frame)[2]).toBe(3);
      },
    );

    it('reference: turns packed points into packets, and tells the producer the rate', async () => {
      const producer = keep(new ReferenceFrameProducer(folder));
      const capture = await start('reference');
      expect(capture.description).toMatchObject({ capacity: 230_400, height: 1 });
      capture.setBudget(BUDGET);
      const frame = await frameWhere(
        capture,
        () => producer.publish(packed(1234, 0xffff)),
        () => true,
      );
      expect(frame.points).toBe(150);
      expect(firstPoint(frame)).toEqual([1, 2, 1234]);
      expect(new Uint16Array(frame.buffer, 16 + 900, 1)[0]).toBe(0xffff);
      expect(producer.wishes).toEqual({ bitsPerSecond: 123_000_000, latencyTest: false });
    });

    describe('reference: a latency test', () => {
      const GREEN = 0x03f0;
      const wishes = { bitsPerSecond: 1e8, latencyTest: true };
      const room: CaptureRoom = {
        points: new Float32Array(150 * 4),
        depth: new Float32Array(0),
        colour: new Uint32Array(0),
      };

      it('asks the producer for one green frame, and that frame is the answer', async () => {
        const producer = keep(new ReferenceFrameProducer(folder));
        const source = keep(await ReferenceShmSource.open({ folder, waitMs: 10_000 }, () => 1000));
        const asked: boolean[] = [];
        const answers: (boolean | undefined)[] = [];
        for (let i = 0; i < 4; i++) {
          const { latencyTest } = producer.wishes;
          asked.push(latencyTest);
          expect(producer.publish(packed(1, latencyTest ? GREEN : 0xffff))).toBe(true);
          answers.push(source.capture(1000 + i, { ...wishes, latencyTest: i < 2 }, room)?.latencyTest);
        }
        expect(asked).toEqual([false, true, false, false]);
        expect(answers).toEqual([false, true, false, false]);
      });

      it('is answered by the next frame if the producer does not support it', async () => {
        const producer = keep(new ReferenceFrameProducer(folder));
        const source = keep(await ReferenceShmSource.open({ folder, waitMs: 10_000 }, () => 1000));
        const answers = [0, 500, 501].map((ms) => {
          producer.publish(packed(1, 0xffff));
          return source.capture(1000 + ms, wishes, room)?.latencyTest;
        });
        expect(answers).toEqual([false, false, true]);
      });
    });

    it('reference: while nobody watches, the producer waits; afterwards the old frame is discarded', async () => {
      const producer = keep(new ReferenceFrameProducer(folder));
      const capture = await start('reference');
      expect(producer.publish(packed(1, 0))).toBe(true);
      let reports = 0;
      await new Promise<void>((resolve) => {
        capture.onState = () => {
          if (++reports === 10) resolve();
        };
      });
      expect(producer.free).toBe(false);
      capture.setBudget(BUDGET);
      const frame = await frameWhere(
        capture,
        () => producer.publish(packed(2, 0)),
        () => true,
      );
      expect(firstPoint(frame)[2]).toBe(2);
    });

    it('reference: an impossible length is a temporary fault', async () => {
      const producer = keep(new ReferenceFrameProducer(folder));
      const capture = await start('reference');
      capture.setBudget(BUDGET);
      const fault = new Promise<string>((resolve) => {
        capture.onFault = resolve;
      });
      const files = referenceFiles(folder);
      const bad = new Uint8Array(1_843_203).fill(255, 0, 3);
      writeFileSync(files.cloud, bad);
      // Again and again: a frame that comes before the budget, or too early for the plan, is skipped unread.
      const timer = every(5, () => {
        // Not by writeFileSync, which makes the file empty first.
        if (producer.free) producer.flags.copyIn(0, Uint8Array.of(1, 0, 0, 0, 0, 0));
      });
      expect(await fault).toContain('shared_pc, byte 0');
      clearInterval(timer);
      const frame = await frameWhere(
        capture,
        () => producer.publish(packed(5, 0)),
        () => true,
      );
      expect(firstPoint(frame)[2]).toBe(5);
    });

    it.each(['farpoint', 'reference'] as const)(
      '%s: says which file is missing if there is no producer',
      async (layout) => {
        const file = layout === 'farpoint' ? 'farpoint_cloud' : 'shared_pc';
        await expect(start(layout, 0)).rejects.toThrow(`${join(folder, file)}: there is no such file`);
      },
    );
  },
);

describe.skipIf(isAvailable())('sources in shared memory, without the addon', () => {
  it('says in one sentence what to do', async () => {
    await expect(start('farpoint')).rejects.toThrow('pnpm build:native');
  });
});
