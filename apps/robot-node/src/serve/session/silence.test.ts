import { expect, it } from 'vitest';
import { silenceLimits, silenceStep } from './silence.ts';

it('checks signaling, then ends the session', () => {
  const limits = silenceLimits(60_000, 3000);
  const steps = [0, 1000, 1001, 60_000, 60_001].map((ms) => silenceStep(ms, limits));
  expect(steps).toEqual(['none', 'none', 'check-signaling', 'check-signaling', 'end']);
});

it('puts no step later than the end of the session', () => {
  const limits = silenceLimits(800, 3000);
  for (const ms of Object.values(limits)) expect(ms).toBeLessThanOrEqual(800);
  expect(silenceStep(801, limits)).toBe('end');
});
