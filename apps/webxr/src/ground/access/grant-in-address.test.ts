import { expect, it, vi } from 'vitest';
import { takeGrantFromAddress } from './grant-in-address.ts';

it('takes the grant out of the address, and leaves the rest', () => {
  const replaceState = vi.fn();
  const history = { state: { x: 1 }, replaceState };
  const location = { pathname: '/', search: '?robot=r1', hash: '#grant=farpoint-ticket.abc' };
  expect(takeGrantFromAddress(location, history)).toEqual({ grant: 'farpoint-ticket.abc', state: null });
  expect(replaceState).toHaveBeenCalledExactlyOnceWith({ x: 1 }, '', '/?robot=r1');
});

it('takes an issuer’s answer', () => {
  const history = { state: null, replaceState: vi.fn() };
  const of = (hash: string) => takeGrantFromAddress({ pathname: '/', search: '', hash }, history);
  expect(of('#grant=a.b.c&state=s1')).toEqual({ grant: 'a.b.c', state: 's1' });
  expect(of('#sign-in-error=cancelled&state=s1')).toEqual({ error: 'cancelled', state: 's1' });
  expect(history.replaceState).toHaveBeenCalledTimes(2);
});

it('leaves an address without a grant alone', () => {
  const replaceState = vi.fn();
  for (const hash of ['', '#', '#top', '#grants=x'])
    expect(
      takeGrantFromAddress({ pathname: '/', search: '', hash }, { state: null, replaceState }),
    ).toBeNull();
  expect(replaceState).not.toHaveBeenCalled();
});
