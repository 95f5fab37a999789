import { beforeEach, describe, expect, it } from 'vitest';
import { SignIn, type TabStorage } from './sign-in.ts';

const ISSUER = 'https://issuer.example/sign-in';
const KEY = 'k'.repeat(43);
const HERE = 'wss://teleop.example';
const stored = new Map<string, string>();
const storage: TabStorage = {
  getItem: (key) => stored.get(key) ?? null,
  setItem: (key, value) => stored.set(key, value),
  removeItem: (key) => stored.delete(key),
};
beforeEach(() => stored.clear());

const begin = (page = 'https://teleop.example/') => new SignIn(storage, HERE).begin(ISSUER, KEY, page, 's1');

describe('signing in', () => {
  it('goes to the issuer with the page’s address, without a token or a fragment', () => {
    const url = new URL(begin('https://teleop.example/?robot=r1&token=secret&ice=relay#grant=x'));
    expect(url.origin + url.pathname).toBe(ISSUER);
    expect(Object.fromEntries(url.searchParams)).toEqual({
      ...{ key: KEY, state: 's1', return: 'https://teleop.example/?robot=r1&ice=relay' },
    });
  });

  it('knows the answer to its question once, also after the page was loaded again', () => {
    begin();
    expect(new SignIn(storage, HERE).isAnsweredBy('s1')).toBe(true);
    expect(new SignIn(storage, HERE).isAnsweredBy('s1')).toBe(false);
  });

  it('takes nothing else for an answer', () => {
    const here = new SignIn(storage, HERE);
    expect(here.isAnsweredBy(null)).toBe(false);
    for (const state of [null, '', 's2']) {
      begin();
      expect(here.isAnsweredBy(state)).toBe(false);
    }
    begin();
    expect(new SignIn(storage, 'wss://other.example').isAnsweredBy('s1')).toBe(false);
    for (const text of ['', '{', '7', '{"state":"s1"}', '{"state":1,"service":2}']) {
      stored.set('farpoint.sign-in', text);
      expect(here.isAnsweredBy('s1')).toBe(false);
    }
  });
});
