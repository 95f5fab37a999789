import { expect, it } from 'vitest';
import { readRepeatOptions } from './repeat-options.ts';

const read = (values: Parameters<typeof readRepeatOptions>[0], platform = 'linux') =>
  readRepeatOptions(values, 2, platform);

it('without options, everything runs once, beside nothing', () => {
  expect(read({})).toEqual({ repeat: 1, load: 0, cpus: null });
});

it('takes whole numbers', () => {
  expect(read({ repeat: '10', load: '2', cpus: '1' })).toEqual({ repeat: 10, load: 2, cpus: 1 });
});

it.each([
  [{ repeat: '0' }, '--repeat: a whole number from 1 to 1000 is needed, not 0'],
  [{ repeat: '1e3' }, '--repeat: a whole number from 1 to 1000 is needed, not 1e3'],
  [{ load: '-1' }, '--load: a whole number from 0 to 64 is needed, not -1'],
  [{ load: '' }, '--load: a whole number from 0 to 64 is needed, not '],
  [{ cpus: '3' }, '--cpus: a whole number from 1 to 2 is needed, not 3'],
])('refuses %j', (values, message) => {
  expect(() => read(values)).toThrow(message);
});

it('says where cores cannot be chosen', () => {
  expect(() => read({ cpus: '1' }, 'darwin')).toThrow('only Linux');
});
