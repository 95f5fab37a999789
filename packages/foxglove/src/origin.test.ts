import { expect, it } from 'vitest';
import { isAllowedOrigin } from './origin.ts';

const rules = (allowedOrigins: string[]) => ({ allowedOrigins, ownNames: ['rover-7.local'] });

it.each([
  ['127.0.0.1:8765', true],
  ['[::1]:8765', true],
  ['192.168.1.5:8765', true],
  ['rover-7.local:8765', true],
  ['evil.example:8765', false],
  ['rover-7.local.evil.example', false],
  [undefined, false],
])('pages of this machine by the name %s', (host, allowed) => {
  expect(isAllowedOrigin('http://localhost:8080', host, rules([]))).toBe(allowed);
  expect(isAllowedOrigin('https://app.foxglove.dev', host, rules([]))).toBe(true);
});

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
  expect(isAllowedOrigin(origin, 'localhost:8765', rules(['https://viewer.example']))).toBe(allowed);
});

it('lets every page connect if it is told to', () => {
  expect(isAllowedOrigin('https://any.example', 'any.example', rules(['*']))).toBe(true);
});
