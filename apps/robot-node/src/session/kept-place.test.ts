import { expect, test } from 'vitest';
import { KeptPlace } from './kept-place.ts';

function driven(): KeptPlace {
  const place = new KeptPlace();
  place.requested('a', 'Ada');
  place.requested('b', 'Bob');
  place.drives('a');
  return place;
}

test('nothing is kept while the driver is there, nor after somebody else has left', () => {
  const place = driven();
  expect(place.keptFrom('Cy', 0)).toBe(0);
  place.ended('b', 0);
  expect(place.keptFrom('Cy', 0)).toBe(0);
});

test('the place of a driver is kept from others for a while, and used once', () => {
  const place = driven();
  // The lease ends before the session does.
  place.drives(null);
  place.ended('a', 1000);
  expect(place.keptFrom('Cy', 1000)).toBe(1);
  expect(place.keptFrom('Ada', 1000)).toBe(0);
  expect(place.keptFrom('Cy', 15_999)).toBe(1);
  expect(place.keptFrom('Cy', 16_000)).toBe(0);
  place.requested('a2', 'Ada');
  expect(place.keptFrom('Cy', 1000)).toBe(0);
});

test('once another drives, it is kept for nobody', () => {
  const place = driven();
  place.ended('a', 0);
  place.drives('b');
  expect(place.keptFrom('Cy', 0)).toBe(0);
  const other = driven();
  other.drives('b');
  other.ended('a', 0);
  expect(other.keptFrom('Cy', 0)).toBe(0);
});

test('a driver’s session is left behind only if it is silent, and only for the driver’s own name', () => {
  const place = driven();
  const heard = () => 1000;
  expect(place.leftBehind('Ada', heard, 2999)).toBeNull();
  expect(place.leftBehind('Ada', heard, 3000)).toBe('a');
  expect(place.leftBehind('Bob', heard, 60_000)).toBeNull();
  place.drives('b');
  expect(place.leftBehind('Ada', heard, 60_000)).toBeNull();
});
