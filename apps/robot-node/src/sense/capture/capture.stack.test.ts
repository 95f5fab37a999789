import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { TimedBaseState } from '@farpoint/cloud-source';
import { emptyPlacement, emptyPointPacketHeader, readCloudPayload } from '@farpoint/protocol';
import { afterEach, describe, expect, it } from 'vitest';
import { NO_BUDGET } from '../encode/capture-budget.ts';
import { SLOT_BYTES, slotPayloadBytes } from '../encode/packetiser.ts';
import type { SourceOptions } from '../sources/open-source.ts';
import { Capture } from './capture.ts';
import type { CaptureOptions, ReadyFrame } from './capture-messages.ts';

const open: Capture[] = [];
afterEach(async () => {
  for (const capture of open.splice(0)) await capture.close();
});

async function start(source: SourceOptions, more: Partial<CaptureOptions> = {}): Promise<Capture> {
  const capture = await Capture.start({
    source,
    framesPerSecond: 60,
    plan: 'paper',
    sampling: { lambda: 3, epsilon: 1e-6, nearDistance: 3.85 },
    floorFraction: 0.1,
    mostPoints: 1_000_000,
    sensor: 0,
    ...more,
  });
  open.push(capture);
  return capture;
}

const sim: SourceOptions = { kind: 'sim', seed: 1, size: 64 };

async function frames(capture: Capture, count: number, recycle = true): Promise<ReadyFrame[]> {
  const got: ReadyFrame[] = [];
  await new Promise<void>((resolve) => {
    capture.onFrame = (frame) => {
      if (got.length < count) got.push(recycle ? { ...frame, buffer: frame.buffer.slice(0) } : frame);
      if (recycle) capture.recycle(frame.buffer);
      if (got.length === count) resolve();
    };
  });
  return got;
}

async function stateWhere(capture: Capture, is: (state: TimedBaseState) => boolean): Promise<TimedBaseState> {
  return new Promise((resolve) => {
    capture.onState = (state) => {
      if (is(state)) resolve(state);
    };
  });
}

function checkPayloads(frame: ReadyFrame): void {
  const header = emptyPointPacketHeader();
  const placement = emptyPlacement();
  for (let i = 0; i < frame.packets; i++) {
    const view = new DataView(
      frame.buffer,
      i * SLOT_BYTES,
      slotPayloadBytes(new Uint8Array(frame.buffer), i),
    );
    expect(readCloudPayload(view, header, placement)).toBeNull();
    expect(header.frameNumber).toBe(frame.frameNumber);
  }
}

describe('capture thread', () => {
  it('gives numbered frames that are ready to send, with times on the robot’s clock', async () => {
    const capture = await start(sim);
    capture.setBudget({ ...NO_BUDGET, targetBitsPerSecond: 20e6, overheadBytes: 68, streaming: true });
    const [a, b] = (await frames(capture, 2)) as [ReadyFrame, ReadyFrame];
    for (const frame of [a, b]) {
      expect(frame.points).toBeGreaterThan(0);
      checkPayloads(frame);
    }
    expect(b.frameNumber).toBe(a.frameNumber + 1);
    expect(b.capturedAtMs).toBeGreaterThan(a.capturedAtMs);
  });

  it('holds no more frames than it has buffers, and continues when one is returned', async () => {
    const capture = await start(sim);
    capture.setBudget({ ...NO_BUDGET, targetBitsPerSecond: 20e6, overheadBytes: 68, streaming: true });
    const held = await frames(capture, 4, false);
    await stateWhere(capture, () => capture.framesWithoutBuffer > 0);
    const next = frames(capture, 1);
    capture.recycle((held[0] as ReadyFrame).buffer);
    const [frame] = await next;
    expect(frame?.frameNumber).toBe(4);
  });
});

const clouds = new URL('../../../../../../shared/data/clouds/', import.meta.url);
describe.skipIf(!existsSync(clouds))('recorded sources (skipped without ../shared/data)', () => {
  it('plays a folder of colour and depth images', async () => {
    const capture = await start({ kind: 'rgbd', path: fileURLToPath(new URL('rgbd-sequence', clouds)) });
    expect(capture.description).toMatchObject({ width: 640, height: 480 });
    capture.setBudget({ ...NO_BUDGET, targetBitsPerSecond: 200e6, overheadBytes: 68, streaming: true });
    const got = await frames(capture, 3);
    for (const frame of got) {
      expect(frame.points).toBeGreaterThan(10_000);
      checkPayloads(frame);
    }
    const state = await stateWhere(capture, () => true);
    expect(state.pose.position).toEqual({ x: 0, y: 0, z: 0 });
  });
});
