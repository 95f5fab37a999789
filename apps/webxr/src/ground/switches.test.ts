import { effect } from '@preact/signals-core';
import { expect, test } from 'vitest';
import { Switches } from './switches.ts';

test('all are on at first; those switched off stay off, by name, also with the next robot', () => {
  const switches = new Switches();
  expect(switches.wanted.value).toEqual([]);
  switches.set([{ name: 'front' }, { name: 'roof' }]);
  expect(switches.wanted.value).toEqual([0, 1]);
  switches.toggle(0);
  expect(switches.wanted.value).toEqual([1]);
  expect(switches.all.value.map(({ on }) => on.value)).toEqual([false, true]);
  switches.set([]);
  switches.set([{ name: 'rear' }, { name: 'front' }]);
  expect(switches.wanted.value).toEqual([0]);
  switches.toggle(1);
  switches.set([{ name: 'front' }]);
  expect(switches.wanted.value).toEqual([0]);
});

test('notifies once per change, and also when another session brings the same list', () => {
  const switches = new Switches();
  const heard: (readonly number[])[] = [];
  effect(() => {
    heard.push(switches.wanted.value);
  });
  const robot = [{ name: 'front' }, { name: 'roof' }];
  switches.set(robot);
  switches.set(robot);
  switches.toggle(1);
  switches.toggle(7);
  expect(heard).toEqual([[], [0, 1], [0, 1], [0]]);
});
