import { expect, it } from 'vitest';
import { FrameBuffers } from './frame-buffers.ts';

it('reuses memory, with room for slightly larger frames, and marks nothing as seen', () => {
  const buffers = new FrameBuffers(1);
  const first = buffers.take(100);
  first.seen.fill(1);
  buffers.giveBack(first);
  const second = buffers.take(120);
  expect(second.bytes.buffer).toBe(first.bytes.buffer);
  expect(second.bytes.length).toBe(960);
  expect([...second.seen]).toEqual(Array(120).fill(0));
  // A larger frame gets new memory. Only a limited number of free buffers are kept.
  const third = buffers.take(1000);
  buffers.giveBack(second);
  buffers.giveBack(third);
  expect(buffers.take(1000).bytes.buffer).not.toBe(third.bytes.buffer);
});
