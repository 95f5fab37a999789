import { describe, expect, it } from 'vitest';
import { encapsulationFault } from './encapsulation.ts';

const fault = (...bytes: number[]) => encapsulationFault('/points', Uint8Array.from(bytes));

describe('the header of a message', () => {
  it.each([
    ['CDR, big endian', 0, 0],
    ['CDR, little endian', 0, 1],
    ['CDR2, big endian', 0, 6],
    ['CDR2, little endian', 0, 7],
  ])('%s is readable', (_, high, low) => {
    expect(fault(high, low, 0, 3, 42)).toBeNull();
  });

  it.each([0, 1, 2, 3])('cut after %d bytes is reported with the byte at which it ends', (length) => {
    const found = fault(...[0, 1, 0, 0].slice(0, length));
    expect(found).toMatchObject({ code: 'bad-message', topic: '/points', offset: length });
  });

  it.each([
    [0, 3, 'PL_CDR'],
    [0, 9, 'D_CDR2'],
    [0, 11, 'PL_CDR2'],
  ])('%d %d is reported as %s', (high, low, name) => {
    const found = fault(high, low, 0, 0);
    expect(found).toMatchObject({ code: 'unsupported', topic: '/points', offset: 0 });
    expect(found?.message).toContain(name);
  });

  it('of anything else is not CDR', () => {
    const found = fault(0xca, 0xfe, 0, 0, 1, 2, 3);
    expect(found).toMatchObject({ code: 'bad-message', offset: 0 });
    expect(found?.message).toContain('0xcafe');
  });
});
