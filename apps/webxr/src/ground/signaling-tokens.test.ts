import fc from 'fast-check';
import { expect, test } from 'vitest';
import { parseTokens, tokenOrigin, withToken } from './signaling-tokens.ts';

test('a token belongs to a scheme, host and port', () => {
  expect(tokenOrigin('wss://x.org/operator?a=b')).toBe('wss://x.org');
  expect(tokenOrigin('wss://user@x.org:443/')).toBe('wss://x.org');
  expect(tokenOrigin('ws://127.0.0.1:3000/operator')).toBe('ws://127.0.0.1:3000');
});

test('reads only origins of services with usable tokens from storage', () => {
  const stored = JSON.parse(
    '{"wss://x.org":"a","wss://x.org/":"b","https://x.org":"c","x.org":"d","wss://y.org":"","wss://z.org":7,"__proto__":"e"}',
  );
  expect([...parseTokens(stored)]).toEqual([['wss://x.org', 'a']]);
  fc.assert(
    fc.property(fc.jsonValue(), (value) => {
      parseTokens(value);
    }),
    { seed: 1 },
  );
});

test('keeps one token per service; an empty token removes it; the oldest are dropped', () => {
  const one = withToken(new Map([['wss://a', '1']]), 'wss://b', '2');
  expect([...withToken(one, 'wss://a', '3')]).toEqual([
    ['wss://b', '2'],
    ['wss://a', '3'],
  ]);
  expect([...withToken(one, 'wss://b', '')]).toEqual([['wss://a', '1']]);
  let many = one;
  for (let i = 0; i < 100; i++) many = withToken(many, `wss://h${i}`, 't');
  expect([many.size, many.has('wss://h99'), many.has('wss://a')]).toEqual([32, true, false]);
});
