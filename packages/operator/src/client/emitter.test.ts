import { expect, test, vi } from 'vitest';
import { Emitter } from './emitter.ts';

interface Events {
  speed: number;
  name: string;
}

test('calls each listener of the type, until it is removed', () => {
  const emitter = new Emitter<Events>();
  const heard: unknown[] = [];
  const stop = emitter.on('speed', (speed) => heard.push(speed));
  emitter.on('speed', (speed) => heard.push(-speed));
  emitter.on('name', (name) => heard.push(name));
  expect(emitter.emit('speed', 1)).toBe(true);
  stop();
  emitter.emit('speed', 2);
  expect(heard).toEqual([1, -1, -2]);
});

test('tells whether there are listeners', () => {
  const emitter = new Emitter<Events>();
  expect(emitter.emit('name', 'a')).toBe(false);
  emitter.on('name', () => undefined)();
  expect(emitter.emit('name', 'a')).toBe(false);
});

test('a listener that throws is reported, and the others are called', () => {
  const tasks: (() => void)[] = [];
  vi.stubGlobal('queueMicrotask', (task: () => void) => tasks.push(task));
  const emitter = new Emitter<Events>();
  const heard: number[] = [];
  emitter.on('speed', () => {
    throw new Error('mine');
  });
  emitter.on('speed', (speed) => heard.push(speed));
  emitter.emit('speed', 3);
  vi.unstubAllGlobals();
  expect(heard).toEqual([3]);
  expect(tasks).toHaveLength(1);
  expect(tasks[0]).toThrow('mine');
});
