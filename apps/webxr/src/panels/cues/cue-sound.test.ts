import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { CueSound, cueTones } from './cue-sound.ts';

/** Stands in for the browser's audio: it runs from when it may until it is told to rest. */
class Context {
  static made: Context[] = [];
  static mayRun: Promise<void> = Promise.resolve();
  readonly destination = {};
  currentTime = 0;
  running = true;

  constructor() {
    Context.made.push(this);
  }

  async resume(): Promise<void> {
    await Context.mayRun;
    this.running = true;
  }

  async suspend(): Promise<void> {
    this.running = false;
  }
}

class Gain {
  readonly gain = { setValueAtTime: () => undefined, linearRampToValueAtTime: () => undefined };
  connect<T>(to: T): T {
    return to;
  }
}

class Oscillator extends Gain {
  static started: Oscillator[] = [];
  onended: (() => void) | null = null;

  start(): void {
    Oscillator.started.push(this);
  }

  stop(): void {
    // It ends when the test says so.
  }
}

beforeEach(() => {
  vi.useFakeTimers();
  Context.made = [];
  Context.mayRun = Promise.resolve();
  Oscillator.started = [];
  vi.stubGlobal('AudioContext', Context);
  vi.stubGlobal('GainNode', Gain);
  vi.stubGlobal('OscillatorNode', Oscillator);
});
afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

test('rests once all tones have ended, and wakes for the next cue', async () => {
  const sound = new CueSound();
  sound.play('held');
  await vi.advanceTimersByTimeAsync(0);
  const [first, second] = Oscillator.started;
  expect(Oscillator.started).toHaveLength(cueTones.held.length);
  first?.onended?.();
  expect(Context.made[0]?.running).toBe(true);
  second?.onended?.();
  expect(Context.made[0]?.running).toBe(false);
  sound.play('slower');
  await vi.advanceTimersByTimeAsync(0);
  expect(Context.made[0]?.running).toBe(true);
  expect(Context.made).toHaveLength(1);
});

test('leaves out a cue that could not be heard at once, and rests', async () => {
  const sound = new CueSound();
  const { promise, resolve } = Promise.withResolvers<void>();
  Context.mayRun = promise;
  sound.play('stop');
  await vi.advanceTimersByTimeAsync(301);
  resolve();
  await vi.advanceTimersByTimeAsync(0);
  expect(Oscillator.started).toEqual([]);
  expect(Context.made[0]?.running).toBe(false);
});

test('is opened beforehand, rests, and is not opened again for a cue', async () => {
  const sound = new CueSound();
  sound.prepare();
  await vi.advanceTimersByTimeAsync(0);
  expect(Context.made).toHaveLength(1);
  expect(Context.made[0]?.running).toBe(false);
  sound.play('held');
  sound.prepare();
  await vi.advanceTimersByTimeAsync(0);
  expect(Context.made[0]?.running).toBe(true);
  expect(Context.made).toHaveLength(1);
});
