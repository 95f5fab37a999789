import { expect, test } from 'vitest';
import { ALL_FRAMES_PER_SECOND, DisplayMeter } from './display-meter.ts';

/** A robot that sends at most what it is told, and a computer that shows at most `shows` of it, for some seconds. */
function run(capacity: DisplayMeter, { sends = 30, shows = 60, seconds = 60, fromMs = 0, frame = 0 } = {}) {
  const changes: number[] = [];
  let sent = frame;
  let [sendsMs, showsMs] = [fromMs, fromMs];
  for (let now = fromMs; now < fromMs + seconds * 1000; now += 5) {
    while (sendsMs <= now) {
      sent++;
      sendsMs += 1000 / Math.min(sends, capacity.framesPerSecond);
    }
    if (now >= showsMs) {
      capacity.onDrawn(sent >>> 0);
      showsMs = now + 1000 / shows;
    }
    if (now % 250 === 0 && capacity.update(now)) changes.push(capacity.framesPerSecond);
  }
  return { changes, frame: sent };
}

test('a computer that shows all wants all', () => {
  const capacity = new DisplayMeter();
  expect(run(capacity).changes).toEqual([]);
  expect(run(new DisplayMeter(), { sends: 60, shows: 60 }).changes).toEqual([]);
  expect(capacity.framesPerSecond).toBe(ALL_FRAMES_PER_SECOND);
});

test('a slower one asks for about what it shows, and tries more ever more seldom', () => {
  const capacity = new DisplayMeter();
  const { changes } = run(capacity, { sends: 30, shows: 8, seconds: 300 });
  expect(changes[0]).toBeGreaterThan(6);
  expect(changes[0]).toBeLessThan(9.5);
  for (const framesPerSecond of changes) expect(framesPerSecond).toBeLessThan(14);
  expect(changes.length).toBeLessThan(20);
});

test('it recovers when the computer does', () => {
  const capacity = new DisplayMeter();
  const { frame } = run(capacity, { shows: 6, seconds: 10 });
  expect(capacity.framesPerSecond).toBeLessThan(10);
  run(capacity, { shows: 60, seconds: 120, fromMs: 10_000, frame });
  expect(capacity.framesPerSecond).toBeGreaterThanOrEqual(30);
});

test('a short hitch, a slow link and a hidden page change nothing', () => {
  const capacity = new DisplayMeter();
  let { frame } = run(capacity, { seconds: 5 });
  // A second without a picture: the robot's frames went on.
  ({ frame } = run(capacity, { seconds: 5, fromMs: 6000, frame: frame + 30 }));
  expect(run(capacity, { sends: 2, seconds: 10, fromMs: 12_000, frame }).changes).toEqual([]);
  capacity.pause();
  expect(run(capacity, { seconds: 5, fromMs: 60_000, frame: 5 }).changes).toEqual([]);
  expect(capacity.framesPerSecond).toBe(ALL_FRAMES_PER_SECOND);
});

test('frame numbers wrap', () => {
  expect(run(new DisplayMeter(), { frame: 0xffff_ffff - 20, seconds: 5 }).changes).toEqual([]);
});
