import { expect, test } from 'vitest';
import { PaintedHint } from './painted-hint.ts';

class Bench {
  readonly said: [number, readonly number[]][] = [];
  readonly hint = new PaintedHint((sensors) => this.said.push([this.nowMs, sensors]));
  readonly cloud = { possible: true, frames: { followed: 0, painted: 0 } };
  nowMs = 0;

  run(forMs: number, painted: boolean): void {
    for (const endMs = this.nowMs + forMs; this.nowMs < endMs; ) {
      this.nowMs += 25;
      if (this.nowMs % 100 === 0) {
        this.cloud.frames.followed++;
        if (painted) this.cloud.frames.painted++;
      }
      this.hint.tick([this.cloud], this.nowMs);
    }
  }
}

test('says nothing until a cloud is painted, then at once and every second', () => {
  const bench = new Bench();
  bench.run(5000, false);
  expect(bench.said).toEqual([]);
  bench.run(7000, true);
  expect(bench.said.length).toBeGreaterThanOrEqual(5);
  expect(bench.said.every(([, sensors]) => sensors.join() === '0')).toBe(true);
  for (const [i, [atMs]] of bench.said.slice(1).entries()) expect(atMs - bench.said[i]![0]).toBe(1000);
  expect(bench.hint.sensors).toEqual([0]);
});

test('says at once, and once, that nothing is painted any more', () => {
  const bench = new Bench();
  bench.run(4000, true);
  bench.cloud.possible = false;
  const { length } = bench.said;
  bench.run(3000, false);
  expect(bench.said.slice(length)).toEqual([[4025, []]]);
});

test('tells the robot of another session what the last one knew', () => {
  const bench = new Bench();
  bench.run(4000, true);
  bench.hint.clear();
  const { length } = bench.said;
  bench.run(4000, true);
  expect(bench.said[length]?.[0]).toBeGreaterThanOrEqual(6000);
});
