import { expect, it, vi } from 'vitest';
import { takeGrantFromAddress } from './grant-in-address.ts';

it('takes the grant out of the address, and leaves the rest', () => {
  const replaceState = vi.fn();
  const history = { state: { x: 1 }, replaceState };
  const location = { pathname: '/', search: '?robot=r1', hash: '#grant=farpoint-ticket.abc' };
  expect(takeGrantFromAddress(location, history)).toBe('farpoint-ticket.abc');
  expect(replaceState).toHaveBeenCalledExactlyOnceWith({ x: 1 }, '', '/?robot=r1');
});

it('leaves an address without a grant alone', () => {
  const replaceState = vi.fn();
  for (const hash of ['', '#', '#top', '#grants=x'])
    expect(
      takeGrantFromAddress({ pathname: '/', search: '', hash }, { state: null, replaceState }),
    ).toBeNull();
  expect(replaceState).not.toHaveBeenCalled();
});
