/** What operators are told of who pressed STOP and who may release it: it agrees with what the guard then does. */
import { estopReleasePolicies } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { makeGuard } from './testing/driven-guard.ts';

const OPERATORS = ['ada', 'bob', 'cy'];

test('nothing is told while nothing is latched', () => {
  const guard = makeGuard();
  expect(guard.estopCause('ada')).toBeNull();
  guard.latchEstop('operator', 'ada');
  expect(guard.estopCause('ada')).toEqual({ type: 'estopCause', latch: 1, yours: true, release: 'driver' });
  guard.holdEstop('gpio');
  expect(guard.estopCause('bob')).toEqual({
    type: 'estopCause',
    latch: 2,
    yours: false,
    heldBy: ['gpio'],
    release: 'driver',
  });
});

test('it is still theirs for who pressed STOP and comes back, and who drives releases it only meanwhile', () => {
  const guard = makeGuard({ estopRelease: 'latcher' });
  guard.identify('s1', 'ada');
  guard.latchEstop('operator', 's1');
  expect(guard.estopCause('s2')).toMatchObject({ yours: false, release: 'latcher' });
  guard.operatorGone('s1');
  expect(guard.estopCause('s2')).toMatchObject({ yours: false, release: 'driver' });
  guard.identify('s3', 'ada');
  expect(guard.estopCause('s3')).toMatchObject({ yours: true, release: 'latcher' });
});

test('who may release it, as it is told, is who the guard lets release it', () => {
  const steps = fc.array(
    fc.record({
      what: fc.constantFrom('latch', 'robot', 'gone', 'drive'),
      who: fc.constantFrom(...OPERATORS),
    }),
    { maxLength: 12 },
  );
  fc.assert(
    fc.property(fc.constantFrom(...estopReleasePolicies), steps, (estopRelease, taken) => {
      const guard = makeGuard({ estopRelease, takePolicy: 'always' });
      for (const { what, who } of taken) {
        if (what === 'latch') guard.latchEstop('operator', who);
        else if (what === 'robot') guard.latchEstop('robot');
        else if (what === 'gone') guard.operatorGone(who);
        else guard.requestLease(who, true, 0);
      }
      const asker = guard.leaseHolder ?? 'ada';
      const told = guard.estopCause(asker);
      expect(told === null).toBe(!guard.estopState().latched);
      const drives = guard.leaseHolder === asker;
      const may = drives && (told?.release === 'driver' || (told?.release === 'latcher' && told.yours));
      const outcome = guard.releaseEstop(asker, false, told?.latch);
      // Its own latch is withdrawn, but others have pressed STOP, too.
      const shared = !outcome.released && outcome.reason === 'others-latched';
      expect(outcome.released || shared).toBe(may);
    }),
    { seed: 7, numRuns: 300 },
  );
});
