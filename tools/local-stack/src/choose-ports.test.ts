import { expect, test } from 'vitest';
import { choosePorts, PortTaken } from './choose-ports.ts';

const taken =
  (...ports: number[]) =>
  async (port: number) =>
    !ports.includes(port);
const wanted = [
  { name: 'signaling', port: 3000 },
  { name: 'reference robots', port: 3001 },
  { name: 'page', port: 5173 },
];

test('the usual ones if they are free', async () => {
  expect(await choosePorts(wanted, taken())).toEqual({ ports: [3000, 3001, 5173], moved: [] });
});

test('otherwise the next free one, but none that another of our programs wants', async () => {
  const { ports, moved } = await choosePorts(wanted, taken(3000, 3002));
  expect(ports).toEqual([3003, 3001, 5173]);
  expect(moved).toEqual([{ wanted: wanted[0], port: 3003 }]);
});

test('no port is given twice', async () => {
  const { ports } = await choosePorts(wanted, taken(3000, 3001));
  expect(ports).toEqual([3002, 3003, 5173]);
});

test('a port requested by its number is not replaced', async () => {
  const fixed = { name: 'page', port: 5173, fixed: true };
  await expect(choosePorts([fixed], taken(5173))).rejects.toThrow(new PortTaken(fixed));
});
