import { expect, it } from 'vitest';
import { silenceLimits, silenceStep } from './silence.ts';

it('asks after signaling, frees the lease, ends the session, in this order', () => {
  const limits = silenceLimits(60_000);
  const steps = [0, 1000, 1001, 5000, 5001, 60_000, 60_001].map((ms) => silenceStep(ms, limits));
  expect(steps).toEqual([
    'none',
    'none',
    'check-signaling',
    'check-signaling',
    'release-lease',
    'release-lease',
    'end',
  ]);
});

it('nothing comes later than the end', () => {
  const limits = silenceLimits(800);
  for (const ms of Object.values(limits)) expect(ms).toBeLessThanOrEqual(800);
  expect(silenceStep(801, limits)).toBe('end');
});
