import type { Base } from '@farpoint/cloud-source';
import { type Twist, zeroTwist } from '@farpoint/protocol';
import { beforeEach, expect, it } from 'vitest';
import { Wheels } from './wheels.ts';

const WATCHDOG_MS = 150;
const forward: Twist = { ...zeroTwist(), linear: { x: 1, y: 0, z: 0 } };

/** Counts the milliseconds for which it drove. */
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

it('stops exactly at the watchdog’s time, however late it checks', () => {
  wheels.apply(forward, 0);
  wheels.advance(5000);
  expect(base.drivenMs).toBe(WATCHDOG_MS);
  expect(wheels.stops).toBe(1);
  wheels.advance(6000);
  expect(wheels.stops).toBe(1);
});

it('stops in time even if the next velocity arrives before the check', () => {
  wheels.apply(forward, 0);
  wheels.apply(forward, 400);
  wheels.advance(450);
  expect(base.drivenMs).toBe(WATCHDOG_MS + 50);
});

it('stands until it gets a velocity, and does not count silence after a zero as a stop', () => {
  wheels.advance(300);
  wheels.apply(zeroTwist(), 300);
  wheels.advance(900);
  expect([base.drivenMs, wheels.stops]).toEqual([0, 0]);
});

it('drives with the old velocity until the new one arrives', () => {
  wheels.apply(forward, 0);
  wheels.apply(zeroTwist(), 100);
  wheels.advance(120);
  expect(base.drivenMs).toBe(100);
});
