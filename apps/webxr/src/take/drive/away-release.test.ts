import { expect, test } from 'vitest';
import { AwayRelease } from './away-release.ts';

test('an operator who has been away for 2 s gives up their turn, once', () => {
  const release = new AwayRelease();
  const at = (away: boolean, ms: number) => release.decide(away, ms);
  expect([at(false, 0), at(true, 100), at(true, 2099), at(true, 2100), at(true, 9000)]).toEqual([
    ...[false, false, false, true, false],
  ]);
  expect([at(false, 9100), at(true, 9200), at(true, 11_199), at(true, 11_200)]).toEqual([
    ...[false, false, false, true],
  ]);
});

test('a glance elsewhere keeps it', () => {
  const release = new AwayRelease();
  for (let ms = 0; ms < 10_000; ms += 100) expect(release.decide(ms % 1000 !== 0, ms)).toBe(false);
});
