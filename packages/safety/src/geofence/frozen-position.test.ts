import { describe, expect, it } from 'vitest';
import { FrozenPosition } from './frozen-position.ts';

const HERE = { x: 10, y: -4 };

/** Drives along x by odometry at 0.5 m/s, asking every 20 ms. @returns how far it came before the position was refused, m */
function driven(judge: FrozenPosition, positionAt: (metres: number) => { x: number; y: number }, most = 20) {
  for (let ms = 0; ms * 0.0005 < most; ms += 20)
    if (judge.judge(positionAt(ms * 0.0005), { x: ms * 0.0005, y: 0 }, ms)) return ms * 0.0005;
  return null;
}

describe('a position', () => {
  it.each([0, 0.5, 3])('that stays the same while odometry goes on is refused (%d m error)', (errorM) => {
    const metres = driven(new FrozenPosition(errorM), () => HERE);
    expect(metres).toBeGreaterThan(1 + 2 * errorM);
    expect(metres).toBeLessThan(1.02 + 2 * errorM);
  });

  it('that moves with the robot is believed, whatever its axes', () => {
    expect(driven(new FrozenPosition(0), (metres) => ({ x: 5, y: 3 - metres }))).toBeNull();
  });

  it('that moves in steps, or holds while the robot is slow, is believed', () => {
    expect(
      driven(new FrozenPosition(0), (metres) => ({ x: Math.floor(metres / 0.9) * 0.9, y: 0 })),
    ).toBeNull();
  });

  it('is believed again as soon as it moves', () => {
    const judge = new FrozenPosition(0);
    driven(judge, () => HERE);
    const at = { x: 1.02, y: 0 };
    expect(judge.judge(HERE, at, 3000)).toBe(true);
    expect(judge.judge({ x: 11, y: -4 }, at, 3020)).toBe(false);
  });

  it.each([
    [4980, true],
    [5000, false],
  ])('is tried again after the robot has stood for five seconds: after %i ms refused: %s', (ms, refused) => {
    const judge = new FrozenPosition(0);
    driven(judge, () => HERE);
    expect(judge.judge(HERE, { x: 2, y: 0 }, 10_000)).toBe(true);
    expect(judge.judge(HERE, { x: 2, y: 0 }, 10_000 + ms)).toBe(refused);
  });

  it('of a robot that only seemed to move is believed again after it has stood, with half of the patience each time', () => {
    const judge = new FrozenPosition(0);
    let [x, ms, goes] = [0, 0, 0];
    // A minute in which the wheels slip whenever they may.
    for (; ms < 60_000; ms += 20) {
      if (judge.judge(HERE, { x, y: 0 }, ms)) continue;
      x += 0.01;
      goes++;
    }
    expect(x).toBeGreaterThan(1.5);
    expect(x).toBeLessThan(2.2);
    expect(goes).toBeGreaterThan(100);
  });

  it('of a robot that stands says nothing against it', () => {
    const judge = new FrozenPosition(0);
    for (let ms = 0; ms < 60_000; ms += 20) expect(judge.judge(HERE, { x: 0, y: 0 }, ms)).toBe(false);
  });
});
