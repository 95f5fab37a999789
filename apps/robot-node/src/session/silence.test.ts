import { expect, it } from 'vitest';
import { silenceLimits, silenceStep } from './silence.ts';

it('checks signaling, then releases the lease, then ends the session', () => {
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

it('puts no step later than the end of the session', () => {
  const limits = silenceLimits(800);
  for (const ms of Object.values(limits)) expect(ms).toBeLessThanOrEqual(800);
  expect(silenceStep(801, limits)).toBe('end');
});
