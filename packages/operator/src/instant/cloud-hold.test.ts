import { describe, expect, test } from 'vitest';
import { CloudHold, driverHold, noHold, watcherHold } from './cloud-hold.ts';

function bench(limit = watcherHold) {
  const hold = new CloudHold(limit);
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
    hold.advance(1000, 0);
    add(1010, 1);
    add(1030, 2);
    add(1066, 3);
    add(1020, 4);
    expect(passed).toEqual([1010]);
    hold.advance(1033, 40);
    expect(passed).toEqual([1010, 1030]);
    hold.advance(1066, 70);
    expect(passed).toEqual([1010, 1030, 1066, 1020]);
    expect(hold.stats.aheadMs?.max).toBe(10);
    expect(hold.stats.heldMs?.max).toBe(67);
  });

  test('that come seldom belong to the nearest picture, too', () => {
    const { hold, passed, add } = bench();
    for (let ms = 0; ms <= 9000; ms += 30) {
      hold.advance(ms, ms);
      if (ms % 90 === 0) add(ms, ms);
    }
    passed.length = 0;
    add(9090, 9001);
    hold.advance(9030, 9030);
    expect(passed).toEqual([]);
    // Half of the 90 ms between clouds before the cloud.
    hold.advance(9060, 9060);
    expect(passed).toEqual([9090]);
  });

  test('that pictures paint wait for the picture of their very instant, no longer than ever', () => {
    const { hold, passed, add } = bench(driverHold);
    hold.exact = true;
    for (let ms = 0; ms <= 990; ms += 33) hold.advance(ms, ms);
    add(1035, 1030);
    // A picture near it would do otherwise.
    hold.advance(1023, 1040);
    expect(passed).toEqual([]);
    hold.advance(1056, 1070);
    expect(passed).toEqual([1035]);
    add(1068, 1071);
    hold.advance(1056, 1110);
    expect(passed).toEqual([1035]);
    // One that does not come is waited for as long as any other.
    hold.advance(1056, 1115);
    expect(passed).toEqual([1035, 1068]);
  });

  test('belong to the nearest picture of slow cameras, and a picture that is left out changes little', () => {
    const { hold, passed, add } = bench();
    for (let ms = 0; ms <= 6600; ms += 66) hold.advance(ms, ms);
    add(6632, 6601);
    add(6636, 6602);
    expect(passed).toEqual([6632]);
    hold.advance(6732, 6732);
    expect(passed).toEqual([6632, 6636]);
    add(6772, 6734);
    expect(passed).toEqual([6632, 6636]);
  });

  test('wait no longer than 200 ms, also for videos that have stopped', () => {
    const { hold, passed, add } = bench();
    hold.advance(1000, 0);
    add(1100, 50);
    hold.advance(1000, 199);
    expect(passed).toEqual([]);
    hold.advance(1000, 201);
    expect(passed).toEqual([1100]);
    add(1500, 450);
    expect(passed).toEqual([1100, 1500]);
  });

  test('all pass when another session begins', () => {
    const { hold, passed, add } = bench();
    hold.advance(1000, 0);
    add(1100, 1);
    hold.clear();
    expect(passed).toEqual([1100]);
    add(5, 2);
    expect(passed).toEqual([1100, 5]);
  });

  test('pass at once if nothing is to be in step', () => {
    const { hold, passed, add } = bench(noHold);
    hold.advance(1000, 0);
    add(1500, 1);
    expect(passed).toEqual([1500]);
    expect(hold.passedMs).toBe(1500);
  });

  test('wait for a driver no longer than from one picture to the next and 10 ms', () => {
    const { hold, passed, add } = bench(driverHold);
    hold.advance(1000, 0);
    hold.advance(1030, 30);
    add(1060, 31);
    hold.advance(1030, 70);
    expect(passed).toEqual([]);
    hold.advance(1030, 71);
    expect(passed).toEqual([1060]);
  });

  test('do not wait for videos that always come too late, and wait again once they come earlier', () => {
    const { hold, passed, add } = bench(driverHold);
    let nowMs = 0;
    /** A cloud and a picture each 30 ms; how old the cloud is when it passes. */
    const run = (videoDelayMs: number, rounds: number) => {
      let waitedMs = 0;
      for (let round = 0; round < rounds; round++) {
        nowMs += 30;
        const { length } = passed;
        add(nowMs, nowMs);
        const addedAtMs = nowMs;
        hold.advance(nowMs - videoDelayMs, nowMs);
        waitedMs = passed.length > length && passed.at(-1) === addedAtMs ? 0 : 1;
      }
      return waitedMs;
    };
    expect(run(40, 10)).toBe(1);
    expect(run(300, 100)).toBe(0);
    expect(run(40, 100)).toBe(1);
  });
});
