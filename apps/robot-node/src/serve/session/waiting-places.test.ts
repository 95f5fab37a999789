import { expect, it } from 'vitest';
import { WaitingPlaces } from './waiting-places.ts';

it('a session that is not answered gives way after a second, the oldest first', () => {
  const places = new WaitingPlaces();
  places.requested('first', 0);
  places.requested('second', 100);
  expect(places.overdue(999)).toBeNull();
  expect(places.overdue(1100)).toBe('first');
  places.settled('first');
  expect(places.overdue(1099)).toBeNull();
  expect(places.overdue(1100)).toBe('second');
});

it('an answered session has 8 s to connect, a connected one never gives way', () => {
  const places = new WaitingPlaces();
  places.requested('slow', 0);
  places.answered('slow');
  expect(places.overdue(7999)).toBeNull();
  expect(places.overdue(8000)).toBe('slow');
  places.settled('slow');
  places.answered('slow');
  expect(places.overdue(100_000)).toBeNull();
});
