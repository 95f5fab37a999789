import { interventions } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { motionWords, speedLimitWords } from './motion-words.ts';

const motion = { factor: 0.5, reasons: [], mostLinear: 0.42, viewAgeMs: 310 } as const;

test('every intervention has words of its own', () => {
  const texts = interventions.map((reason) => motionWords({ ...motion, reasons: [reason] })?.text);
  expect(new Set(texts).size).toBe(interventions.length);
  expect(texts).not.toContain('');
});

test('the strictest reason is told, and a robot that is held is worse than one that is slower', () => {
  expect(motionWords({ ...motion, reasons: ['view-late', 'blind-travel'] })).toEqual({
    text: 'Slower: what you see is 310 ms old',
    tone: 'warning',
  });
  expect(motionWords({ ...motion, factor: 0, reasons: ['obstacle'] })?.tone).toBe('bad');
  expect(motionWords(motion)).toBe(null);
  expect(motionWords(undefined)).toBe(null);
});

test('the limit of the speed is told where it is less than the robot’s own', () => {
  const telemetry = { motion } as unknown as Parameters<typeof speedLimitWords>[0];
  expect(speedLimitWords(telemetry, 1)?.text).toBe('0.42 m/s: what you see is 310 ms old');
  expect(speedLimitWords(telemetry, 0.4)).toBe(null);
});
