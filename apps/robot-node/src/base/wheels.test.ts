import { type Twist, zeroTwist } from '@farpoint/protocol';
import { beforeEach, expect, it } from 'vitest';
import type { Base } from './base.ts';
import { Wheels } from './wheels.ts';

const WATCHDOG_MS = 150;
const forward: Twist = { ...zeroTwist(), linear: { x: 1, y: 0, z: 0 } };

/** Counts the milliseconds that it drove. */
class Odometer implements Base {
  drivenMs = 0;
  #lastMs = 0;

  advance(nowMs: number, { linear }: Twist): void {
    this.drivenMs += (nowMs - this.#lastMs) * linear.x;
    this.#lastMs = nowMs;
  }

  get state(): never {
    throw new Error('not asked for');
  }
}

let base: Odometer;
let wheels: Wheels;
beforeEach(() => {
  base = new Odometer();
  wheels = new Wheels(base, WATCHDOG_MS);
});

it('drives while the velocity is repeated', () => {
  for (let now = 0; now <= 1000; now += 40) wheels.apply(forward, now);
  expect(base.drivenMs).toBe(1000);
  expect(wheels.stops).toBe(0);
});

it('stops at the watchdog’s time to the millisecond, however late it looks', () => {
  wheels.apply(forward, 0);
  wheels.advance(5000);
  expect(base.drivenMs).toBe(WATCHDOG_MS);
  expect(wheels.stops).toBe(1);
  wheels.advance(6000);
  expect(wheels.stops).toBe(1);
});

it('stops in time also where the next word comes first', () => {
  wheels.apply(forward, 0);
  wheels.apply(forward, 400);
  wheels.advance(450);
  expect(base.drivenMs).toBe(WATCHDOG_MS + 50);
});

it('stands until it was told to move, and silence after a zero is no stop', () => {
  wheels.advance(300);
  wheels.apply(zeroTwist(), 300);
  wheels.advance(900);
  expect([base.drivenMs, wheels.stops]).toEqual([0, 0]);
});

it('drives under the old velocity until the new one comes', () => {
  wheels.apply(forward, 0);
  wheels.apply(zeroTwist(), 100);
  wheels.advance(120);
  expect(base.drivenMs).toBe(100);
});
