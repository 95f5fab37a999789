import { describe, expect, test } from 'vitest';
import { CloudHold } from './cloud-hold.ts';

function bench() {
  const hold = new CloudHold();
  const passed: number[] = [];
  return {
    hold,
    passed,
    add: (captureMs: number, nowMs: number) => hold.add(captureMs, nowMs, () => passed.push(captureMs)),
  };
}

describe('clouds', () => {
  test('pass at once while no video is shown', () => {
    const { passed, add } = bench();
    add(1000, 0);
    expect(passed).toEqual([1000]);
  });

  test('wait for the videos that were captured with them, and keep their order', () => {
    const { hold, passed, add } = bench();
    hold.tick(1000, 0);
    add(1010, 1);
    add(1066, 2);
    add(1020, 3);
    expect(passed).toEqual([1010]);
    hold.tick(1040, 60);
    expect(passed).toEqual([1010]);
    hold.tick(1066, 70);
    expect(passed).toEqual([1010, 1066, 1020]);
    expect(hold.stats.aheadMs?.max).toBe(10);
    expect(hold.stats.heldMs?.max).toBe(68);
  });

  test('belong to the nearest picture of slow cameras', () => {
    const { hold, passed, add } = bench();
    hold.tick(1000, 0);
    hold.tick(1067, 67);
    add(1095, 70);
    add(1105, 71);
    expect(passed).toEqual([1095]);
  });

  test('wait no longer than 200 ms, also for videos that have stopped', () => {
    const { hold, passed, add } = bench();
    hold.tick(1000, 0);
    add(1100, 50);
    hold.tick(1000, 199);
    expect(passed).toEqual([]);
    hold.tick(1000, 201);
    expect(passed).toEqual([1100]);
    add(1500, 450);
    expect(passed).toEqual([1100, 1500]);
  });

  test('all pass when another session begins', () => {
    const { hold, passed, add } = bench();
    hold.tick(1000, 0);
    add(1100, 1);
    hold.clear();
    expect(passed).toEqual([1100]);
    add(5, 2);
    expect(passed).toEqual([1100, 5]);
  });
});
