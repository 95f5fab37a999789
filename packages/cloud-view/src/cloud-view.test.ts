import { BATCH_BYTES, Batch, type CloudSource } from '@farpoint/operator';
import { emptyPlacement } from '@farpoint/protocol';
import type { WebGLRenderer } from 'three';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { CloudView } from './cloud-view.ts';

const page = { hidden: false };
beforeEach(() => {
  page.hidden = false;
  vi.stubGlobal('document', page);
});
afterEach(() => vi.unstubAllGlobals());

/** WebGL that takes every call and counts them. */
function graphics() {
  const calls: Record<string, number> = {};
  const gl = new Proxy({} as Record<string, unknown>, {
    get: (_, name: string) => {
      if (name === name.toUpperCase()) return 0;
      return () => {
        calls[name] = (calls[name] ?? 0) + 1;
        return {};
      };
    },
  });
  return { gl, calls };
}

/** A view of a robot whose clouds the test makes. */
function setUp(sensor?: number) {
  const { gl, calls } = graphics();
  const domElement = Object.assign(new EventTarget(), { height: 720 });
  const xr = { isPresenting: false };
  const renderer = { getContext: () => gl, domElement, xr, state: { bindFramebuffer() {} } };
  const listeners = new Map<string, (event: never) => void>();
  const released: Batch[] = [];
  const uploaded: number[] = [];
  const latency = { wantsTime: false };
  const source = {
    pointsAtMs: 0,
    latency,
    on: (type: string, listener: (event: never) => void) => {
      listeners.set(type, listener);
      return () => void listeners.delete(type);
    },
    release: (batch: Batch) => void released.push(batch),
    noteUploaded: (_: Batch, packet: number) => void uploaded.push(packet),
    noteDrawn: vi.fn(),
  };
  const view = new CloudView(
    renderer as unknown as WebGLRenderer,
    source as unknown as CloudSource,
    sensor === undefined ? {} : { sensor },
  );
  return {
    view,
    calls,
    domElement,
    xr,
    source,
    latency,
    released,
    uploaded,
    listeners,
    tell: (type: string, event: unknown) => listeners.get(type)?.(event as never),
    /** A frame comes, in so many packets of 100 points. */
    give: (frameNumber: number, packets = 1, y = 0) => {
      const batch = new Batch(new ArrayBuffer(BATCH_BYTES));
      const placement = emptyPlacement();
      placement.pose.position.y = y;
      for (let packet = 0; packet < packets; packet++) {
        const header = {
          frameNumber,
          frameLength: packets * 800,
          sequenceOffset: packet * 800,
          sequenceLength: 800,
        };
        batch.add(header, placement, 100, 1000, { imageExtent: 1.5, unit: 0.001, cover: 2 });
      }
      listeners.get('cloud')?.(batch as never);
      return batch;
    },
  };
}

test('points that came are drawn at the next display frame, and their batch goes back once', () => {
  const { view, give, released, uploaded } = setUp();
  expect([view.visible, view.hasPoints]).toEqual([false, false]);
  const batch = give(1, 2, 3);
  expect([released, view.drawn]).toEqual([[], 0]);
  view.update(1000);
  expect([view.visible, view.drawn, view.newestFrame, view.endedFrame]).toEqual([true, 200, 1, 1]);
  expect([view.frames, view.packets, view.points]).toEqual([1, 2, 200]);
  expect([released, uploaded, view.imageExtent, view.cameraPosition.y]).toEqual([[batch], [0, 1], 1.5, 3]);
  view.update(1016);
  expect([released.length, view.packets]).toEqual([1, 2]);
});

test('a newer frame takes the place of an older one; a packet that comes after it is dropped', () => {
  const { view, give } = setUp();
  give(1);
  give(3);
  give(2);
  view.update(1000);
  expect([view.newestFrame, view.frames, view.drops.late]).toEqual([3, 2, 1]);
});

test('a page that draws too rarely drops the oldest, says so, and gives their batches back', () => {
  const { view, give, released } = setUp();
  for (let frame = 1; frame <= 45; frame++) give(frame, 2);
  expect([view.drops['page-behind'], released.length]).toEqual([10, 5]);
  view.update(1000);
  expect([view.newestFrame, released.length]).toEqual([45, 45]);
});

test('a hidden page takes nothing, unless the headset shows it', () => {
  const { view, give, released, xr } = setUp();
  page.hidden = true;
  give(1);
  view.update(1000);
  expect([released.length, view.hasPoints]).toEqual([1, false]);
  xr.isPresenting = true;
  Object.assign(xr, { getCamera: () => ({ cameras: [] }) });
  give(2);
  view.update(1016);
  expect([released.length, view.newestFrame]).toEqual([2, 2]);
});

test.each([
  ['session', 2],
  ['phase', 'none'],
])('nothing of an earlier session is left: %s', (type, event) => {
  const { view, give, released, tell } = setUp();
  give(1);
  view.update(1000);
  give(2);
  tell(type, event);
  expect([view.visible, view.hasPoints, view.frames, view.points, view.drawn, released.length]).toEqual([
    false,
    false,
    0,
    0,
    0,
    2,
  ]);
});

test('a session that goes on keeps its points', () => {
  const { view, give, tell } = setUp();
  give(1);
  view.update(1000);
  tell('phase', 'live');
  expect(view.newestFrame).toBe(1);
});

test('a graphics context that comes back has new buffers and no points', () => {
  const { view, give, domElement, calls } = setUp();
  give(1);
  view.update(1000);
  const { createBuffer } = calls;
  domElement.dispatchEvent(new Event('webglcontextrestored'));
  expect([view.hasPoints, calls.createBuffer]).toEqual([false, (createBuffer ?? 0) + 1]);
});

test('the GPU is waited for only while a frame is timed', () => {
  const { view, source, latency, calls } = setUp();
  view.noteDrawn();
  expect([calls.readPixels, source.noteDrawn.mock.calls.length]).toEqual([undefined, 1]);
  latency.wantsTime = true;
  view.noteDrawn();
  expect([calls.readPixels, source.noteDrawn.mock.calls.length]).toEqual([1, 2]);
});

test('another sensor’s clouds are drawn if it is asked for', () => {
  expect([...setUp(2).listeners.keys()]).toContain('cloud:2');
  expect([...setUp(0).listeners.keys()]).toContain('cloud');
});

test('a view that is disposed of listens to nothing and holds no batch', () => {
  const { view, give, released, listeners, domElement, calls } = setUp();
  give(1);
  view.dispose();
  expect([released.length, listeners.size]).toEqual([1, 0]);
  const { createBuffer } = calls;
  domElement.dispatchEvent(new Event('webglcontextrestored'));
  expect(calls.createBuffer).toBe(createBuffer);
});
