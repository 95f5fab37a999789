import { activeInput, toTwist } from '@farpoint/operator';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { STANDARD_MAP } from './controller-map.ts';
import { shapeAxis } from './dead-zone.ts';
import { GamepadInput } from './gamepad-input.ts';
import { HeadsetInput } from './headset-input.ts';
import { DEFAULT_KEYS } from './key-map.ts';
import { KeyboardInput } from './keyboard-input.ts';

const RESPONSE = { deadZone: 0.12, expo: 0.4 };
const limits = { maxLinear: 1.2, maxAngular: 2 };

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

describe('toTwist', () => {
  test('maps forward to linear.x and left to angular.z, scaled to the robot’s limits', () => {
    expect(toTwist({ forward: 1, left: -0.5 }, limits)).toEqual({
      linear: { x: 1.2, y: 0, z: 0 },
      angular: { x: 0, y: 0, z: -1 },
    });
  });

  test('never exceeds the limits and is never NaN', () => {
    fc.assert(
      fc.property(fc.double(), fc.double(), (forward, left) => {
        const { linear, angular } = toTwist({ forward, left }, limits);
        expect(Math.abs(linear.x)).toBeLessThanOrEqual(limits.maxLinear);
        expect(Math.abs(angular.z)).toBeLessThanOrEqual(limits.maxAngular);
        expect(Object.is(linear.x, -0) || Object.is(angular.z, -0)).toBe(false);
      }),
      { seed: 2 },
    );
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

test('with one key at a time, a key for a direction is the grip as well; other keys do as they were chosen', () => {
  const keys = new KeyboardInput();
  keys.key('KeyW', true, 0);
  keys.setKeys({ ...DEFAULT_KEYS, forward: ['KeyI'] }, true);
  // Whatever was held counts as released.
  expect([keys.held, keys.wish.forward]).toEqual([false, 0]);
  expect(keys.key('KeyW', true, 1)).toBe(false);
  keys.key('KeyI', true, 2);
  expect([keys.held, keys.wish.forward]).toEqual([true, 1]);
  keys.key('KeyI', false, 3);
  expect([keys.held, keys.wish.forward, keys.readMs]).toEqual([false, 0, 3]);
});

test('a keyboard is read while the page runs, at a new grip and when it opens', () => {
  const keys = new KeyboardInput();
  keys.key('Space', true, 10);
  keys.key('Space', true, 20);
  keys.key('KeyW', true, 30);
  expect(keys.readMs).toBe(10);
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

  test('an unplugged controller lets go, and drives again only once it has been opened', () => {
    const input = new GamepadInput();
    const held = (state: ReturnType<typeof pad> | null) => {
      input.read(state, 0);
      return input.held;
    };
    expect([
      held(pad([], [5])),
      held(null),
      held(pad([], [5])),
      held(pad([], [])),
      held(pad([], [5])),
    ]).toEqual([...[true, false, false, false, true]]);
  });

  test('a wheel: a pedal counts once it has been read at its rest; a new map opens the grip', () => {
    const axis = { axis: 0, centre: 0, least: -1, most: 1, inverted: true, deadZone: 0.1 };
    const pedal = (index: number) => ({ ...axis, axis: index, centre: 1 });
    const wheel = {
      sticks: [{ forward: pedal(1), back: pedal(2), left: axis }],
      buttons: { ...STANDARD_MAP.buttons, grip: [0], latencyTest: [] },
    };
    const input = new GamepadInput();
    const read = (axes: number[], down: number[]) => {
      input.read(pad(axes, down), 0, wheel);
      return { ...input.wish };
    };
    // What browsers report before a pedal is touched: half of its way.
    expect(read([0, 0, 0], [0])).toEqual({ forward: 0, left: 0 });
    read([0, 1, 1], [0]);
    expect(read([0, -1, 1], [0])).toEqual({ forward: 1, left: 0 });
    expect(read([-1, 1, -1], [0])).toEqual({ forward: -1, left: 1 });
    expect(read([0, -1, -1], [0]).forward).toBe(0);
    expect(input.held).toBe(true);
    input.read(pad([0, 1, 1], [0]), 0, { ...wheel });
    expect(input.held).toBe(false);
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
    const left = new HeadsetInput('left');
    left.read([controller('left', 1, 0, -1), controller('right', 1, 0.8, 1)], 0, tracked);
    expect([left.held, left.wish, left.turnStick]).toEqual([true, { forward: 1, left: 0 }, 0.8]);
    left.read([controller('left', 0, 0, 0), controller('right', 1, 0.8, 1)], 0, tracked);
    expect(left.held).toBe(false);
  });

  test('says when the driving hand’s stick is pushed without a grip, and not of what is no wish to drive', () => {
    const input = new HeadsetInput();
    const pushed = (
      sources: ReturnType<typeof controller>[],
      isTracked = true,
      grabbing = false,
      inMenu = false,
    ) => {
      input.read(sources, 0, () => isTracked, grabbing, inMenu);
      return input.pushed;
    };
    for (const [x, y] of [
      [0, -1],
      [-0.5, null],
    ] as const)
      expect(pushed([controller('right', 0, x, y)])).toBe(true);
    expect(pushed([controller('right', 1, 0, -1)])).toBe(false);
    expect(pushed([controller('right', 0, 0.05, -0.05)])).toBe(false);
    expect(pushed([controller('left', 0, 0, -1)])).toBe(false);
    const right = [controller('right', 0, 0, -1)];
    expect(pushed(right, false)).toBe(false);
    expect(pushed(right, true, true)).toBe(false);
    expect(pushed(right, true, false, true)).toBe(false);
    expect(pushed(right)).toBe(true);
    input.release();
    expect(input.pushed).toBe(false);
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

  test('the other hand’s A or X shows the next view, and its stick recentres, once per press', () => {
    const input = new HeadsetInput();
    const read = (...sources: ReturnType<typeof controller>[]) => input.read(sources, 0, tracked);
    expect(read(controller('left', 0, 0, 0, 4))).toMatchObject({ nextView: true, menu: false });
    expect(read(controller('left', 0, 0, 0, 4))).toMatchObject({ nextView: false });
    expect(read(controller('left', 0, 0, 0, 3))).toMatchObject({ recentre: true, nextRobot: false });
    expect(read(controller('left', 0, 0, 0, 3))).toMatchObject({ recentre: false });
    expect(read(controller('left', 0, 0, 0, 5))).toMatchObject({ estop: true });
    expect(read(controller('right', 0, 0, 0, 4))).toMatchObject({ nextView: false, menu: true });
    expect(read(controller('right', 0, 0, 0, 3))).toMatchObject({ recentre: false, nextRobot: true });
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

  test('A or X opens the menu, B or Y is the emergency stop, once per press', () => {
    const input = new HeadsetInput();
    expect(input.read([controller('right', 0, 0, 0, 4)], 0, tracked)).toMatchObject({
      estop: false,
      menu: true,
      nextRobot: false,
    });
    expect(input.read([controller('right', 0, 0, 0, 5)], 0, tracked)).toMatchObject({
      estop: true,
      menu: false,
      nextRobot: false,
    });
    expect(input.read([controller('right', 0, 0, 0, 5)], 0, tracked)).toMatchObject({
      estop: false,
      menu: false,
      nextRobot: false,
    });
  });

  test('while the menu is open nothing drives, STOP stops, and sticks and their buttons are the menu’s', () => {
    const input = new HeadsetInput();
    const read = (inMenu: boolean, ...sources: ReturnType<typeof controller>[]) =>
      input.read(sources, 0, tracked, false, inMenu);
    const fist = controller('right', 1, 0, -1);
    read(false, fist);
    expect(input.held).toBe(true);
    read(true, fist);
    expect([input.held, input.wish.forward, input.menuStick]).toEqual([false, 0, -1]);
    // The menu opens by letting go of everything: a stick that is deflected then has not been centred by that.
    input.release();
    expect(input.menuStick).toBe(-1);
    expect(read(true, controller('right', 0, 0, 0, 5)).estop).toBe(true);
    expect(read(true, controller('right', 0, 0, 0, 3))).toMatchObject({ choose: true, nextRobot: false });
    read(true, controller('right', 0, 0, 0));
    expect(read(true, controller('left', 0, 0, 1, 3))).toMatchObject({ choose: true, recentre: false });
    expect(input.menuStick).toBe(1);
    expect(read(true, controller('left', 0, 0, 0, 4))).toMatchObject({ menu: true, nextView: false });
    expect(read(false, controller('right', 0, 0, 0, 3)).choose).toBe(false);
    // A grip that was squeezed in the menu drives only once it has been opened.
    read(true, fist);
    read(false, fist);
    expect(input.held).toBe(false);
    read(false, controller('right', 0, 0, 0));
    read(false, fist);
    expect(input.held).toBe(true);
  });

  test('a trigger that is pulled for the menu does not release the emergency stop, also when the menu has closed', () => {
    const input = new HeadsetInput();
    const held = (inMenu: boolean, ...sources: ReturnType<typeof controller>[]) =>
      input.read(sources, 0, tracked, false, inMenu).releaseHeld;
    const pulled = controller('right', 0, 0, 0, 0);
    expect(held(true, pulled)).toBe(false);
    expect(held(false, pulled)).toBe(false);
    expect(held(false, pulled, controller('left', 0, 0, 0, 0))).toBe(false);
    expect(held(false, controller('right', 0, 0, 0))).toBe(false);
    expect(held(false, pulled)).toBe(true);
    // Opening the menu ends a hold that has begun.
    expect(held(true, pulled)).toBe(false);
    expect(held(false, pulled)).toBe(false);
  });

  test('the stick of a controller that is not tracked moves no mark', () => {
    const input = new HeadsetInput();
    input.read([controller('right', 0, 0, 1)], 0, () => false, false, true);
    expect(input.menuStick).toBe(0);
    input.read([controller('right', 0, null, null)], 0, tracked, false, true);
    expect(input.menuStick).toBe(0);
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
