import { expect, test } from 'vitest';
import { EMPTY_MAP, STANDARD_MAP } from './controller-map.ts';
import { type ConnectedPad, Gamepads } from './gamepads.ts';
import { DEFAULT_CHOICES } from './input-choices.ts';
import { InputSettings } from './input-settings.ts';

const RAW = 'raw:stick';
const axis = { axis: 1, centre: 0, least: -1, most: 1, inverted: true, deadZone: 0.1 };
const learnt = {
  ...EMPTY_MAP,
  sticks: [{ forward: axis, back: null, left: null }],
  buttons: { ...EMPTY_MAP.buttons, grip: [0], estop: [2] },
};

function pad(down: readonly number[], of: Partial<ConnectedPad> = {}): ConnectedPad {
  const buttons = Array.from({ length: 17 }, (_, i) => {
    const pressed = down.includes(i);
    return { pressed, value: Number(pressed) };
  });
  return { id: 'stick', mapping: '', axes: [0, -1], buttons, ...of };
}

function open(controllers: ReadonlyMap<string, typeof learnt> = new Map()) {
  const settings = new InputSettings({ ...DEFAULT_CHOICES, controllers }, () => {});
  const told: string[] = [];
  const gamepads = new Gamepads(settings, {
    onUnknown: (id) => told.push(`unknown ${id}`),
    onUnplugged: (id) => told.push(`gone ${id}`),
  });
  let nowMs = 0;
  const read = (...pads: (ConnectedPad | null)[]) => {
    nowMs += 25;
    return { ...gamepads.read(pads, nowMs), held: gamepads.all.map(({ held }) => held).indexOf(true) };
  };
  return { settings, gamepads, told, read };
}

test('a gamepad in the standard mapping drives without setup, beside a device that does not', () => {
  const { read, told, gamepads } = open();
  expect(read(pad([0, 4]), null, pad([4], { id: 'pad', mapping: 'standard' })).held).toBe(2);
  expect(gamepads.all[2]?.wish.forward).toBe(1);
  expect(gamepads.all[0]?.wish.forward).toBe(0);
  expect(told).toEqual(['unknown stick']);
});

test('a device that nobody has set up does nothing, and is told of once', () => {
  const { read, told } = open();
  for (let i = 0; i < 3; i++)
    expect(read(pad([0, 1, 2, 3, 4, 5, 6, 7, 9, 12]))).toEqual({
      ...{ estop: false, latencyTest: false, nextRobot: false, faster: false, slower: false },
      ...{ releaseHeld: false, held: -1 },
    });
  read(null);
  read(pad([]));
  expect(told).toEqual(['unknown stick']);
});

test('while devices are set up none drives nor presses anything but STOP; then the grip must be opened first', () => {
  const { read, gamepads } = open(new Map([[RAW, learnt]]));
  read(pad([]));
  expect(read(pad([0])).held).toBe(0);
  gamepads.settingUp = true;
  expect(read(pad([0])).held).toBe(-1);
  expect(gamepads.all[0]?.wish).toEqual({ forward: 0, left: 0 });
  expect(read(pad([0, 2])).estop).toBe(true);
  const standard = { id: 'pad', mapping: 'standard' };
  expect(read(null, pad([0, 1, 3, 9, 12, 13], standard))).toMatchObject({
    ...{ estop: true, latencyTest: false, nextRobot: false, faster: false, slower: false },
    releaseHeld: false,
  });
  read(pad([0]));
  gamepads.settingUp = false;
  expect([read(pad([0])).held, read(pad([])).held, read(pad([0])).held]).toEqual([-1, -1, 0]);
});

test('another mapping drives only once the grip has been opened', () => {
  const { read, settings } = open(new Map([[RAW, learnt]]));
  read(pad([]));
  expect(read(pad([0])).held).toBe(0);
  settings.setController(RAW, { ...learnt, buttons: { ...learnt.buttons, grip: [0, 5] } });
  expect([read(pad([0])).held, read(pad([])).held, read(pad([5])).held]).toEqual([-1, -1, 0]);
});

test('a device that is gone has let go, and drives again only once its grip has been opened', () => {
  const standard = { id: 'pad', mapping: 'standard' };
  const usual = open();
  expect(usual.read(pad([4], standard)).held).toBe(0);
  usual.read(null);
  expect([usual.read(pad([4], standard)).held, usual.read(pad([], standard)).held]).toEqual([-1, -1]);
  expect(usual.read(pad([4], standard)).held).toBe(0);
  for (const gone of [null, pad([0], { connected: false })]) {
    const { read, told, gamepads } = open(new Map([[RAW, learnt]]));
    read(pad([]));
    expect(read(pad([0])).held).toBe(0);
    expect(read(gone).held).toBe(-1);
    expect(gamepads.all[0]?.wish).toEqual({ forward: 0, left: 0 });
    expect(read(pad([0])).held).toBe(-1);
    read(pad([]));
    expect(read(pad([0])).held).toBe(0);
    expect(told).toEqual(['gone stick']);
  }
});

test('another device in the same place does not take over the grip of the one before it', () => {
  const { read } = open(new Map([[RAW, learnt]]));
  read(pad([4], { id: 'a', mapping: 'standard' }));
  expect(read(pad([4], { id: 'a', mapping: 'standard' })).held).toBe(0);
  expect(read(pad([4], { id: 'b', mapping: 'standard' })).held).toBe(-1);
});

test('eight devices are read; further ones are not there', () => {
  const { read, gamepads } = open();
  const pads = Array.from({ length: 9 }, (_, i) =>
    pad(i === 8 ? [1] : [], { id: `${i}`, mapping: 'standard' }),
  );
  expect(read(...pads).estop).toBe(false);
  expect(gamepads.all).toHaveLength(8);
  expect(read(...pads.slice(1)).estop).toBe(true);
});

test('what is usual stays the same object: a map that is read is not a new one', () => {
  const { settings } = open();
  expect(settings.mapOf('standard:pad')).toBe(STANDARD_MAP);
  expect(settings.mapOf('raw:pad')).toBe(EMPTY_MAP);
});
