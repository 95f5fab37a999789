import { EventEmitter } from 'node:events';
import { expect, test } from 'vitest';
import { KeyStop } from './key-stop.ts';

class FakeConsole extends EventEmitter {
  readonly isTTY = true;
  raw = false;
  setRawMode(raw: boolean): void {
    this.raw = raw;
  }
  pause(): void {}
  type(text: string): void {
    this.emit('data', Buffer.from(text));
  }
}

function open() {
  const console = new FakeConsole();
  const states: string[] = [];
  const stop = new KeyStop(console, false, () => states.push('interrupt'));
  stop.onChange = () => states.push(stop.look(0));
  return { console, states, stop };
}

test.each([...'release', ' ', '\r', '\u001b', '\u007f'])('the first key stops at once, also %j', (key) => {
  const { console, states, stop } = open();
  expect(stop.look(0)).toBe('go');
  console.type(key);
  expect(states).toEqual(['pressed']);
});

test('the word releases once Enter completes it, and not before', () => {
  const { console, states, stop } = open();
  console.type('x');
  for (const key of 'release') console.type(key);
  expect(stop.look(0)).toBe('pressed');
  console.type('\r');
  expect(stop.look(0)).toBe('go');
  console.type('r');
  expect(stop.look(0)).toBe('pressed');
  expect(states.filter((state) => state === 'go')).toHaveLength(1);
});

test('a console that is gone stops', () => {
  const { console, states, stop } = open();
  console.emit('end');
  expect(states).toEqual(['lost']);
  expect(stop.fault).toBe('the console is gone');
});
