import {
  applyRobotsChanged,
  decodeJson,
  type RobotListing,
  type ServiceToOperator,
  serviceToOperatorCodec,
} from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { robotWords } from './robot-registry.ts';
import { VersionedListing } from './versioned-listing.ts';

const read = (bytes: Uint8Array): ServiceToOperator => decodeJson(serviceToOperatorCodec, bytes);

test('reports what was added, removed and changed since a version, each robot once', () => {
  const robots = new Map([['a', { id: 'a', name: 'A', key: 'secret' }]]);
  const listing = new VersionedListing(robots, robotWords);
  expect(read(listing.whole())).toEqual({ type: 'robots', robots: [{ id: 'a', name: 'A' }] });
  const { version } = listing;
  robots.set('b', { id: 'b', name: 'B', key: 'secret' });
  listing.changed('b');
  robots.set('b', { id: 'b', name: 'Bert', key: 'secret' });
  listing.changed('b');
  robots.delete('a');
  listing.changed('a');
  const changed = { type: 'robots.changed', here: [{ id: 'b', name: 'Bert' }], gone: ['a'] };
  expect(read(listing.since(version))).toEqual(changed);
  expect(read(listing.since(version + 2))).toEqual({ type: 'robots.changed', here: [], gone: ['a'] });
});

test('is encoded once for everyone with the same version', () => {
  const listing = new VersionedListing(new Map(), robotWords);
  listing.changed('a');
  expect(listing.since(0)).toBe(listing.since(0));
  expect(listing.whole()).toBe(listing.whole());
});

test('sends the whole list to whoever is too far behind', () => {
  const listing = new VersionedListing(new Map([['a', { id: 'a', name: 'A' }]]), robotWords, 4);
  for (let i = 0; i < 9; i++) listing.changed(`r${i}`);
  expect(read(listing.since(4)).type).toBe('robots');
  expect(read(listing.since(5)).type).toBe('robots.changed');
});

test('applying the changes always gives the list, whatever happens and however late they are requested', () => {
  const step = fc.record({ id: fc.constantFrom('a', 'b', 'c', 'd'), name: fc.constantFrom('x', 'y', null) });
  fc.assert(
    fc.property(fc.array(fc.record({ step, asks: fc.nat(3) }), { maxLength: 60 }), (steps) => {
      const robots = new Map<string, RobotListing>();
      const listing = new VersionedListing(robots, robotWords, 5);
      // Three operators that ask at different times.
      const operators = [0, 1, 2].map(() => ({ version: 0, list: [] as RobotListing[] }));
      const update = (operator: { version: number; list: RobotListing[] }): void => {
        const message = read(listing.since(operator.version));
        if (message.type === 'robots') operator.list = message.robots;
        else if (message.type === 'robots.changed')
          operator.list = applyRobotsChanged(operator.list, message);
        operator.version = listing.version;
      };
      for (const { step, asks } of steps) {
        if (step.name === null) robots.delete(step.id);
        else robots.set(step.id, { id: step.id, name: step.name });
        listing.changed(step.id);
        const operator = operators[asks];
        if (operator !== undefined) update(operator);
      }
      const sorted = (list: Iterable<RobotListing>) => [...list].sort((x, y) => x.id.localeCompare(y.id));
      for (const operator of operators) {
        update(operator);
        expect(sorted(operator.list)).toEqual(sorted(robots.values()));
      }
    }),
    { seed: 5 },
  );
});
