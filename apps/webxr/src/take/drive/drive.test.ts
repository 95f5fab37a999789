import { activeInput } from '@farpoint/operator';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { shapeAxis } from './dead-zone.ts';
import { GamepadInput } from './gamepad-input.ts';
import { HeadsetInput } from './headset-input.ts';
import { KEY_PRESETS } from './key-map.ts';
import { KeyboardInput } from './keyboard-input.ts';

const RESPONSE = { deadZone: 0.12, expo: 0.4 };

describe('shapeAxis', () => {
  test('is 0 inside the dead zone and ±1 at full deflection', () => {
    expect(shapeAxis(0.12, RESPONSE)).toBe(0);
    expect(shapeAxis(-0.1, RESPONSE)).toBe(0);
    expect(shapeAxis(1, RESPONSE)).toBe(1);
    expect(shapeAxis(-1, RESPONSE)).toBe(-1);
    expect(shapeAxis(3, RESPONSE)).toBe(1);
  });

  test('null, undefined and NaN count as centred', () => {
    for (const value of [null, undefined, Number.NaN]) expect(shapeAxis(value, RESPONSE)).toBe(0);
  });

  test('rises steadily from the dead zone, symmetrically in both directions', () => {
    const deflection = fc.double({ min: 0, max: 1, noNaN: true });
    fc.assert(
      fc.property(deflection, deflection, (a, b) => {
        const [low, high] = a < b ? [a, b] : [b, a];
        expect(shapeAxis(low, RESPONSE)).toBeLessThanOrEqual(shapeAxis(high, RESPONSE));
        expect(shapeAxis(-high, RESPONSE)).toBeCloseTo(-shapeAxis(high, RESPONSE), 12);
      }),
      { seed: 1 },
    );
    expect(shapeAxis(0.121, RESPONSE)).toBeLessThan(0.002);
  });
});

describe('KeyboardInput', () => {
  test('drives while Space or Shift is held', () => {
    const keys = new KeyboardInput();
    expect(keys.key('KeyW', true, 0)).toBe(true);
    expect(keys.held).toBe(false);
    keys.key('Space', true, 0);
    keys.key('ArrowLeft', true, 0);
    expect(keys.held).toBe(true);
    expect(keys.wish).toEqual({ forward: 1, left: 1 });
    keys.key('KeyS', true, 0);
    expect(keys.wish.forward).toBe(0);
    keys.releaseAll();
    expect(keys.held).toBe(false);
    expect(keys.wish).toEqual({ forward: 0, left: 0 });
    expect(keys.key('KeyQ', true, 0)).toBe(false);
  });
});

test('other keys drive once they are chosen, and whatever was held counts as released', () => {
  const keys = new KeyboardInput();
  keys.key('Space', true, 0);
  keys.key('KeyW', true, 0);
  keys.setKeys(KEY_PRESETS.right);
  expect([keys.held, keys.wish.forward]).toEqual([false, 0]);
  expect(keys.key('KeyW', true, 0)).toBe(false);
  keys.key('Numpad0', true, 0);
  keys.key('Numpad8', true, 0);
  keys.key('KeyJ', true, 0);
  expect([keys.held, keys.wish]).toEqual([true, { forward: 1, left: 1 }]);
});

test('Shift that types a question mark is no grip, unless a key for a direction or another grip is held with it', () => {
  const keys = new KeyboardInput();
  expect(keys.letGoOfShift(0)).toBe(false);
  keys.key('ShiftRight', true, 0);
  expect([keys.letGoOfShift(1), keys.held]).toEqual([true, false]);
  keys.key('ShiftLeft', true, 2);
  keys.key('KeyA', true, 2);
  expect([keys.letGoOfShift(3), keys.held]).toEqual([false, true]);
  keys.key('KeyA', false, 4);
  keys.key('Space', true, 4);
  expect([keys.letGoOfShift(5), keys.held]).toEqual([false, true]);
});

test('a keyboard is read while the page runs, at a new grip and when it opens', () => {
  const keys = new KeyboardInput();
  keys.key('Space', true, 10);
  keys.key('Space', true, 20);
  keys.key('KeyW', true, 30);
  expect(keys.readMs).toBe(10);
  keys.runs(30);
  keys.runs(40);
  expect(keys.readMs).toBe(40);
  keys.key('Space', false, 50);
  expect(keys.readMs).toBe(50);
});

const button = (value: number) => ({ pressed: value > 0.5, value });

describe('GamepadInput', () => {
  const pad = (axes: (number | null)[], down: number[]) => ({
    axes,
    buttons: Array.from({ length: 17 }, (_, index) => button(down.includes(index) ? 1 : 0)),
  });

  test('drives with the stick that is deflected more, while a shoulder button is held', () => {
    const input = new GamepadInput();
    input.read(pad([0, 0, 1, -1], [5]), 0);
    expect(input.held).toBe(true);
    expect(input.wish).toEqual({ forward: 1, left: -1 });
    input.read(pad([0, 1, 0, 0], []), 0);
    expect(input.held).toBe(false);
    expect(input.wish.forward).toBe(-1);
    input.read(null, 0);
    expect(input.wish).toEqual({ forward: 0, left: 0 });
  });

  test('after a release a shoulder button drives only once it has been opened', () => {
    const input = new GamepadInput();
    const held = (down: number[]) => {
      input.read(pad([], down), 0);
      return input.held;
    };
    expect(held([5])).toBe(true);
    input.release();
    expect([held([5]), held([]), held([5])]).toEqual([false, false, true]);
  });

  test('reports each button once per press', () => {
    const input = new GamepadInput();
    expect(input.read(pad([], [1]), 0).estop).toBe(true);
    expect(input.read(pad([], [1]), 0).estop).toBe(false);
    expect(input.read(pad([], [0]), 0)).toMatchObject({ estop: false, latencyTest: true, nextRobot: false });
    expect(input.read(pad([], [9]), 0).nextRobot).toBe(true);
    expect(input.read(pad([], [9]), 0).nextRobot).toBe(false);
  });

  test('reports Y for as long as it is held, and never reports B', () => {
    const input = new GamepadInput();
    for (const [down, held] of [
      [[3], true],
      [[3, 1], true],
      [[1], false],
    ] as const) {
      expect(input.read(pad([], [...down]), 0).releaseHeld).toBe(held);
      expect(input.read(pad([], [...down]), 0).releaseHeld).toBe(held);
    }
    expect(input.read(null, 0).releaseHeld).toBe(false);
  });
});

describe('HeadsetInput', () => {
  const tracked = () => true;
  const controller = (
    handedness: string,
    squeeze: number,
    x: number | null,
    y: number | null,
    extra = -1,
  ) => ({
    handedness,
    gamepad: {
      axes: [null, null, x, y],
      buttons: Array.from({ length: 6 }, (_, i) => button(i === 1 ? squeeze : i === extra ? 1 : 0)),
    },
  });

  test('drives with the hand that squeezes; pushing the stick forward reads −1', () => {
    const input = new HeadsetInput();
    input.read([controller('left', 0, 0, 1), controller('right', 1, -1, -1)], 0, tracked);
    expect(input.held).toBe(true);
    expect(input.wish).toEqual({ forward: 1, left: 1 });
  });

  test('the other hand’s grip and stick never drive; its stick turns the view', () => {
    const right = new HeadsetInput();
    right.read([controller('left', 1, 0.8, 1), controller('right', 0, 0, 0)], 0, tracked);
    expect([right.held, right.wish.forward, right.turnStick]).toEqual([false, 0, 0.8]);
    right.read([controller('left', 1, -1, 1), controller('right', 1, 0.5, -1)], 0, tracked);
    expect([right.held, right.wish.forward, right.turnStick]).toEqual([true, 1, -1]);
    expect(right.wish.left).toBeLessThan(0);
    const left = new HeadsetInput({ driveHand: 'left' });
    left.read([controller('left', 1, 0, -1), controller('right', 1, 0.8, 1)], 0, tracked);
    expect([left.held, left.wish, left.turnStick]).toEqual([true, { forward: 1, left: 0 }, 0.8]);
    left.read([controller('left', 0, 0, 0), controller('right', 1, 0.8, 1)], 0, tracked);
    expect(left.held).toBe(false);
  });

  test('a stick that is pushed with an open grip is noticed, unless a hand holds the model', () => {
    const input = new HeadsetInput();
    const pushed = (sources: ReturnType<typeof controller>[], isTracked = true, grabbing = false) => {
      input.read(sources, 0, () => isTracked, grabbing);
      return input.pushed;
    };
    expect(pushed([controller('right', 0, 0, -0.6)])).toBe(true);
    // A thumb that rests, the turning hand, an unknown hand, a grip that drives.
    expect(pushed([controller('right', 0, 0.3, -0.3)])).toBe(false);
    expect(pushed([controller('left', 0, 0, -1)])).toBe(false);
    expect(pushed([controller('right', 0, 0, -1)], false)).toBe(false);
    expect(pushed([controller('right', 1, 0, -1)])).toBe(false);
    expect(pushed([controller('right', 0, 0, -1)], true, true)).toBe(false);
    pushed([controller('right', 0, 0, -1)]);
    input.release();
    expect(input.pushed).toBe(false);
  });

  test('where the driving hand is another one now, both hands must open before one drives', () => {
    const settings: { driveHand: 'right' | 'left' } = { driveHand: 'right' };
    const input = new HeadsetInput(settings);
    const both = (left: number, right: number) =>
      input.read([controller('left', left, 0, -1), controller('right', right, 0, -1)], 0, tracked);
    both(1, 1);
    expect(input.held).toBe(true);
    settings.driveHand = 'left';
    both(1, 1);
    expect([input.held, input.wish.forward]).toEqual([false, 0]);
    both(1, 0);
    expect(input.held).toBe(false);
    both(0, 1);
    both(1, 1);
    expect([input.held, input.wish.forward]).toEqual([true, 1]);
  });

  test('a hand that is not tracked turns nothing, nor does one without a stick', () => {
    const input = new HeadsetInput();
    input.read([controller('left', 0, 1, 0)], 0, () => false);
    expect(input.turnStick).toBe(0);
    input.read([controller('left', 0, null, null)], 0, tracked);
    expect(input.turnStick).toBe(0);
    input.read([controller('left', 0, 1, 0)], 0, tracked);
    input.read([], 0, tracked);
    expect(input.turnStick).toBe(0);
  });

  test('the other hand’s grip is read while it is tracked; while it is held, no trigger releases the emergency stop', () => {
    const input = new HeadsetInput();
    const read = (...sources: ReturnType<typeof controller>[]) => input.read(sources, 0, tracked);
    expect(input.otherGrip).toBe('away');
    expect(read(controller('left', 1, 0, 0, 0)).releaseHeld).toBe(false);
    expect([input.otherGrip, input.held]).toEqual(['held', false]);
    expect(read(controller('left', 1, 0, 0), controller('right', 0, 0, 0, 0)).releaseHeld).toBe(false);
    expect(read(controller('left', 0, 0, 0, 0)).releaseHeld).toBe(true);
    expect(input.otherGrip).toBe('open');
    read(controller('right', 1, 0, 0));
    expect(input.otherGrip).toBe('away');
    input.read([controller('left', 1, 0, 0)], 0, () => false);
    expect(input.otherGrip).toBe('away');
    read(controller('left', 1, 0, 0));
    input.release();
    expect(input.otherGrip).toBe('away');
  });

  test('while a hand holds the model nothing drives, nor a grip squeezed meanwhile before it has been opened', () => {
    const input = new HeadsetInput();
    const fist = [controller('right', 1, 0, -1)];
    const held = (sources: ReturnType<typeof controller>[], grabbing: boolean) => {
      input.read(sources, 0, tracked, grabbing);
      return input.held;
    };
    expect(held(fist, true)).toBe(false);
    expect(input.wish.forward).toBe(0);
    expect(held(fist, false)).toBe(false);
    expect(held([controller('right', 0, 0, -1)], true)).toBe(false);
    expect(held(fist, false)).toBe(true);
    // Whatever the page takes for a grab stops a robot that is being driven.
    expect(held(fist, true)).toBe(false);
    expect(held(fist, false)).toBe(false);
  });

  test('A or X opens the menu, the other hand’s shows the next view and its stick recentres, B or Y stops: once per press', () => {
    const input = new HeadsetInput();
    const read = (...sources: ReturnType<typeof controller>[]) => input.read(sources, 0, tracked);
    expect(read(controller('left', 0, 0, 0, 4))).toMatchObject({ nextView: true, menu: false });
    expect(read(controller('left', 0, 0, 0, 4))).toMatchObject({ nextView: false });
    expect(read(controller('left', 0, 0, 0, 3))).toMatchObject({ recentre: true, nextRobot: false });
    expect(read(controller('left', 0, 0, 0, 3))).toMatchObject({ recentre: false });
    expect(read(controller('left', 0, 0, 0, 5))).toMatchObject({ estop: true });
    expect(read(controller('right', 0, 0, 0, 4))).toMatchObject({ nextView: false, menu: true });
    expect(read(controller('right', 0, 0, 0, 4))).toMatchObject({ menu: false, latencyTest: false });
    expect(read(controller('right', 0, 0, 0, 3))).toMatchObject({ recentre: false, nextRobot: true });
    expect(read(controller('right', 0, 0, 0, 5))).toMatchObject({ estop: true, menu: false });
    expect(read(controller('right', 0, 0, 0, 5))).toMatchObject({ estop: false });
    // Nothing opens before the eyes of a hand that drives.
    expect(read(controller('right', 1, 0, 0, 4)).menu).toBe(false);
  });

  test('in the menu sticks and triggers are the menu’s, either hand closes it, B and Y stop, and the grip drives', () => {
    const input = new HeadsetInput();
    const read = (...sources: ReturnType<typeof controller>[]) =>
      input.read(sources, 0, tracked, false, true);
    expect(read(controller('left', 0, 1, 0.8, 3))).toMatchObject({ recentre: false, releaseHeld: false });
    expect([input.turnStick, input.menuStick]).toEqual([0, 0.8]);
    expect(read(controller('right', 0, 0, -1, 3))).toMatchObject({ nextRobot: false });
    expect([input.pushed, input.menuStick]).toEqual([false, -1]);
    expect(read(controller('left', 0, 0, 0, 4))).toMatchObject({ menu: true, nextView: false });
    expect(read(controller('right', 0, 0, 0, 4)).menu).toBe(true);
    expect(read(controller('left', 0, 0, 0, 5)).estop).toBe(true);
    read(controller('right', 1, 0, -1));
    expect([input.held, input.wish.forward]).toEqual([true, 1]);
    input.read([controller('right', 0, 0, -1)], 0, () => false, false, true);
    expect(input.menuStick).toBe(0);
  });

  test('a trigger that was pulled for the console releases no STOP before it has been let go', () => {
    const input = new HeadsetInput();
    const pulled = [controller('right', 0, 0, 0, 0)];
    expect(input.read(pulled, 0, tracked, false, true).releaseHeld).toBe(false);
    expect(input.read(pulled, 0, tracked).releaseHeld).toBe(false);
    input.read([controller('right', 0, 0, 0)], 0, tracked);
    expect(input.read(pulled, 0, tracked).releaseHeld).toBe(true);
    // The press may be told of before the reading has it, and after its end.
    input.triggerClaimed = true;
    input.read([controller('right', 0, 0, 0)], 0, tracked);
    expect(input.read(pulled, 0, tracked).releaseHeld).toBe(false);
    input.triggerClaimed = false;
    expect(input.read(pulled, 0, tracked).releaseHeld).toBe(false);
    input.read([controller('right', 0, 0, 0)], 0, tracked);
    expect(input.read(pulled, 0, tracked).releaseHeld).toBe(true);
  });

  test('is not read while the driving hand is not tracked', () => {
    const input = new HeadsetInput();
    const fist = [controller('right', 1, 0, -1)];
    input.read(fist, 10, () => true);
    input.read(fist, 20, () => false);
    expect([input.held, input.readMs]).toEqual([true, 10]);
    input.read(fist, 30, () => true);
    expect(input.readMs).toBe(30);
    // An open hand needs no tracking.
    input.read([controller('right', 0, 0, 0)], 40, () => false);
    expect([input.held, input.readMs]).toEqual([false, 40]);
  });

  test('after a release a fist drives only once it has been opened', () => {
    const input = new HeadsetInput();
    const fist = [controller('right', 1, 0, -1)];
    input.read(fist, 10, tracked);
    input.release();
    input.read(fist, 20, tracked);
    expect([input.held, input.wish.forward]).toEqual([false, 0]);
    input.read([controller('right', 0, 0, -1)], 30, tracked);
    input.read(fist, 40, tracked);
    expect([input.held, input.wish.forward]).toEqual([true, 1]);
  });

  test('treats null axes and sources without a gamepad as centred', () => {
    const input = new HeadsetInput();
    input.read(
      [{ handedness: 'none' }, { handedness: 'none', gamepad: null }, controller('right', 1, null, null)],
      0,
      tracked,
    );
    expect(input.held).toBe(true);
    expect(input.wish).toEqual({ forward: 0, left: 0 });
  });

  test('pressing a stick switches to the next robot, once per press and never while a hand drives', () => {
    const input = new HeadsetInput();
    expect(input.read([controller('right', 0, 0, 0, 3)], 0, tracked).nextRobot).toBe(true);
    expect(input.read([controller('right', 0, 0, 0, 3)], 0, tracked).nextRobot).toBe(false);
    input.read([controller('right', 0, 0, 0)], 0, tracked);
    expect(input.read([controller('right', 1, 0, -1, 3)], 0, tracked).nextRobot).toBe(false);
    expect(input.read([controller('right', 0, 0, 0, 3)], 0, tracked).nextRobot).toBe(false);
  });

  test('a bare hand that the headset tracks neither drives, releases, speaks nor turns the view', () => {
    const input = new HeadsetInput();
    const bare = (handedness: string) => ({ ...controller(handedness, 1, 1, -1, 0), hand: {} });
    const { releaseHeld } = input.read([bare('left'), bare('right')], 5, tracked);
    expect([input.held, releaseHeld, input.turnStick, input.readMs]).toEqual([false, false, 0, 5]);
    input.read([bare('left'), controller('right', 1, 0, -1)], 10, tracked);
    expect([input.held, input.talks, input.wish.forward]).toEqual([true, false, 1]);
    // Whoever puts the controller away lets go.
    input.read([bare('left'), bare('right')], 20, tracked);
    expect(input.held).toBe(false);
  });

  test('counts the trigger as release only while the grip is open: a clenched fist holds both', () => {
    const input = new HeadsetInput();
    const held = (...sources: ReturnType<typeof controller>[]) => input.read(sources, 0, tracked).releaseHeld;
    expect(held(controller('left', 0, 0, 0, 0))).toBe(true);
    expect(held(controller('right', 1, 0, 0, 0))).toBe(false);
    expect(held(controller('left', 0, 0, 0, 0), controller('right', 1, 0, 0))).toBe(false);
    expect(held(controller('left', 0, 0, 0, 5))).toBe(false);
    expect(held(controller('right', 0, 0, 0, 0))).toBe(true);
  });

  test('speaks by the trigger of the other hand while one drives', () => {
    const input = new HeadsetInput();
    const talks = (...sources: ReturnType<typeof controller>[]) => {
      input.read(sources, 0, tracked);
      return input.talks;
    };
    expect(talks(controller('left', 0, 0, 0, 0), controller('right', 1, 0, 0))).toBe(true);
    expect(talks(controller('left', 0, 0, 0, 0), controller('right', 0, 0, 0))).toBe(false);
    // A fist clenched in fright.
    expect(talks(controller('left', 0, 0, 0), controller('right', 1, 0, 0, 0))).toBe(false);
    talks(controller('left', 0, 0, 0, 0), controller('right', 1, 0, 0));
    input.release();
    expect(input.talks).toBe(false);
  });
});

test('lets one device drive at a time: the one that started', () => {
  const device = (held: boolean) => ({
    name: 'touch' as const,
    held,
    wish: { forward: 0, left: 0 },
    readMs: 0,
  });
  const [a, b] = [device(true), device(true)];
  expect(activeInput([a, b], null)).toBe(a);
  expect(activeInput([a, b], b)).toBe(b);
  b.held = false;
  expect(activeInput([a, b], b)).toBe(a);
  a.held = false;
  expect(activeInput([a, b], a)).toBe(null);
});

describe('keys for sideways', () => {
  const hold = (keys: KeyboardInput, ...codes: string[]) => codes.map((code) => keys.key(code, true, 0));

  test('are none of the keyboard’s with a robot that cannot', () => {
    const keys = new KeyboardInput();
    expect(hold(keys, 'Space', 'Comma')).toEqual([true, false]);
    expect(keys.wish).toEqual({ forward: 0, left: 0 });
    expect(keys.pushed).toBe(false);
  });

  test('drive one that can, beside the others; with another robot they have let go', () => {
    const keys = new KeyboardInput();
    keys.setSideways(true);
    hold(keys, 'Space', 'KeyW', 'Comma');
    expect(keys.wish).toEqual({ forward: 1, left: 0, sideways: 1 });
    hold(keys, 'Period');
    expect(keys.wish).toEqual({ forward: 1, left: 0 });
    keys.key('Comma', false, 0);
    expect(keys.wish.sideways).toBe(-1);
    expect(keys.pushed).toBe(true);
    keys.setSideways(false);
    expect([keys.held, keys.wish]).toEqual([false, { forward: 0, left: 0 }]);
  });
});
