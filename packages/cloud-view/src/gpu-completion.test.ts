import type { WebGLRenderer } from 'three';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { GpuCompletion } from './gpu-completion.ts';

/** A GPU that finishes when told to. */
function gpu() {
  const state = { done: false, lost: false, fences: 0 };
  const gl = {
    ...{ SYNC_GPU_COMMANDS_COMPLETE: 1, SYNC_STATUS: 2, UNSIGNALED: 3, SIGNALED: 4 },
    fenceSync: () => {
      state.fences++;
      return {};
    },
    deleteSync: () => {
      state.fences--;
    },
    flush: () => {},
    isContextLost: () => state.lost,
    getSyncParameter: () => (state.done ? 4 : 3),
  };
  const completion = new GpuCompletion({ getContext: () => gl } as unknown as WebGLRenderer);
  const costs: number[] = [];
  completion.onCost = (costMs) => costs.push(costMs);
  return { state, completion, costs };
}

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

it('a picture that is finished early is cheap, however long the display frame is', () => {
  const { state, completion, costs } = gpu();
  completion.mark();
  state.done = true;
  vi.advanceTimersByTime(16);
  expect(completion.busy).toBe(false);
  expect(costs).toEqual([5]);
});

it('a picture that takes longer costs the time until it is found finished, once', () => {
  const { state, completion, costs } = gpu();
  completion.mark();
  vi.advanceTimersByTime(16);
  expect(completion.busy).toBe(true);
  vi.advanceTimersByTime(17);
  state.done = true;
  expect(completion.busy).toBe(false);
  expect(completion.busy).toBe(false);
  expect(costs).toEqual([33]);
  expect(state.fences).toBe(0);
});

it('a lost context keeps nothing waiting', () => {
  const { state, completion } = gpu();
  completion.mark();
  state.lost = true;
  expect(completion.busy).toBe(false);
});
