import { expect, it } from 'vitest';
import { type ConnectedPad, gamepadName, PickGamepad } from './pick-gamepad.ts';

const pad = (id: string, mapping: string, pressed = false): ConnectedPad => ({
  ...{ id, mapping, buttons: [{ pressed: false }, { pressed }] },
});

it('takes the first gamepad in the standard mapping, and says nothing of others beside it', () => {
  const picks = new PickGamepad();
  const told: string[] = [];
  const known = pad('known', 'standard');
  expect(picks.pick([null, pad('wheel', '', true), known], (name) => told.push(name))).toBe(known);
  expect(told).toEqual([]);
});

it('tells once of each other one that somebody uses', () => {
  const picks = new PickGamepad();
  const told: string[] = [];
  const read = (...pads: (ConnectedPad | null)[]) => picks.pick(pads, (name) => told.push(name));
  expect(read(pad('stick', ''), null)).toBeNull();
  expect(told).toEqual([]);
  for (let i = 0; i < 3; i++) expect(read(pad('stick', '', true))).toBeNull();
  read(pad('stick', '', true), pad('xr', 'xr-standard', true));
  expect(told).toEqual(['stick', 'xr']);
});

it('names it as people do', () => {
  expect(gamepadName('DragonRise Pad (Vendor: 0079 Product: 0006)')).toBe('DragonRise Pad');
  expect(gamepadName('')).toBe('');
  expect(gamepadName('x'.repeat(500)).length).toBe(40);
});
