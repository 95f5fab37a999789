import { expect, it } from 'vitest';
import { isAllowedOrigin } from './origin.ts';

it.each([
  [undefined, true],
  ['https://app.foxglove.dev', true],
  ['file://', true],
  ['http://localhost:8080', true],
  ['http://127.0.0.1', true],
  ['http://[::1]:5173', true],
  ['https://viewer.example', true],
  ['https://evil.example', false],
  ['http://localhost.evil.example', false],
  ['https://app.foxglove.dev.evil.example', false],
  ['http://app.foxglove.dev', false],
  ['null', false],
  ['', false],
])('pages of %s', (origin, allowed) => {
  expect(isAllowedOrigin(origin, ['https://viewer.example'])).toBe(allowed);
});

it('lets every page connect if it is told to', () => {
  expect(isAllowedOrigin('https://any.example', ['*'])).toBe(true);
});
