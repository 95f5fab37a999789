import fc from 'fast-check';
import { expect, it } from 'vitest';
import { hostRefusal, isOwnHost, ownNames } from './own-names.ts';

const names = ownNames(['Teleop.Example.org', 'robots.example.'], 'Rover-7.lab.example');

it.each([
  ['localhost:3000', true],
  ['robot.localhost', true],
  ['127.0.0.1:3000', true],
  ['[::1]:3000', true],
  ['192.168.1.5', true],
  ['[fe80::1]', true],
  ['rover-7.lab.example', true],
  ['ROVER-7:3000', true],
  ['rover-7.local', true],
  ['rover-7.local.', true],
  ['teleop.example.org:443', true],
  ['robots.example', true],
  [undefined, true],
  ['evil.example', false],
  ['rover-7.evil.example', false],
  ['rover-7.local.evil.example', false],
  ['localhost.evil.example', false],
  ['127.0.0.1.evil.example', false],
  ['evil.example.', false],
  ['other', false],
  ['', false],
  ['evil.example@127.0.0.1', false],
  ['127.0.0.1/evil.example', false],
  ['no host', false],
])('a request for %s is for this machine: %s', (host, own) => {
  expect(isOwnHost(host, names)).toBe(own);
});

it('no name of somebody else’s is an own one, whatever stands before it', () => {
  fc.assert(
    fc.property(
      fc.domain(),
      fc.constantFrom('', 'localhost.', 'rover-7.', '127.0.0.1.'),
      (domain, before) => {
        expect(isOwnHost(`${before}${domain}`, names)).toBe(names.has(domain.toLowerCase()));
      },
    ),
  );
});

it('a refusal says how to allow the name, and repeats nothing else', () => {
  expect(hostRefusal('evil.example:3000', '--public-names')).toContain('"evil.example": if');
  expect(hostRefusal('a b<script>', '--public-names')).toContain('""');
});
