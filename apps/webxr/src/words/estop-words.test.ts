import type { EstopCause, EstopState } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { type EstopFacts, latchedStop } from './estop-words.ts';

const estop: EstopState = { type: 'estop', latched: true, by: 'operator', latch: 7 };
const cause: EstopCause = { type: 'estopCause', latch: 7, pressedBy: 'Ada', yours: false, release: 'driver' };

function facts(given: Partial<EstopFacts> = {}): EstopFacts {
  return { estop, cause, holder: 'nobody', driver: null, role: null, heard: true, ...given };
}

test('there is nothing to say while it is not latched', () => {
  expect(latchedStop(facts({ estop: { type: 'estop', latched: false, latch: 7 }, cause: null }))).toBeNull();
});

test.each([
  [facts(), 'Ada pressed STOP.'],
  [facts({ cause: { ...cause, yours: true } }), 'You pressed STOP.'],
  [facts({ cause: null }), 'An operator pressed STOP.'],
  [facts({ cause: null, estop: { ...estop, by: 'robot' } }), 'The robot has stopped itself.'],
  [facts({ cause: { ...cause, heldBy: ['topic', 'shm'] } }), 'The robot is stopped by a program on it.'],
  [
    facts({ cause: { ...cause, heldBy: ['gpio', 'key'] } }),
    'The robot is stopped by its own stop button and a key at its own keyboard.',
  ],
  [
    facts({ cause: { ...cause, pressedBy: undefined, start: 'unclean-exit' } }),
    'The robot’s program did not shut down in order: it crashed, or lost its power.',
  ],
  [facts({ cause: { ...cause, start: 'was-latched' } }), 'Ada pressed STOP.'],
])('why %#: %s', (given, why) => {
  expect(latchedStop(given)?.why).toBe(why);
});

test.each([
  ['nobody drives', facts(), null],
  ['this operator drives', facts({ holder: 'you', role: 'drive' }), null],
  [
    'a supervisor',
    facts({ holder: 'other', role: 'supervise', cause: { ...cause, release: 'supervisor' } }),
    null,
  ],
  ['another drives', facts({ holder: 'other', driver: 'Grace' }), 'Grace releases it.'],
  ['another without a name drives', facts({ holder: 'other' }), 'Whoever drives releases it.'],
  ['a watcher', facts({ role: 'watch' }), 'lets you watch'],
  ['supervisors only', facts({ cause: { ...cause, release: 'supervisor' } }), 'Only a supervisor'],
  ['another pressed it', facts({ cause: { ...cause, release: 'latcher' } }), 'Ada, or a supervisor'],
  ['this operator pressed it', facts({ cause: { ...cause, yours: true, release: 'latcher' } }), null],
  [
    'a stop at the robot',
    facts({ estop: { ...estop, releasedAt: 'robot' }, role: 'supervise' }),
    'at the robot',
  ],
])('%s: who may release it', (_, given, words) => {
  const stop = latchedStop(given);
  expect(stop?.mayRelease).toBe(words === null);
  expect(stop?.release).toContain(words ?? 'Hold the release control');
});

test('what the robot said before it fell silent is no longer offered as if it counted', () => {
  const stop = latchedStop(facts({ heard: false, role: 'supervise' }));
  expect(stop).toMatchObject({ why: 'Ada pressed STOP.', mayRelease: false, heard: false });
  expect(stop?.release).toContain('before it fell silent');
});
