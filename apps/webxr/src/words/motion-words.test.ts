import { interventions, type MotionState, zeroTwist } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { motionWords, speedLimitWords, speedWords } from './motion-words.ts';

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

test('the speed is told with what it may be now, and with why it may not be more', () => {
  const twist = zeroTwist();
  twist.linear.x = -0.416;
  const asked = zeroTwist();
  asked.linear.x = -0.8;
  const told = (of: Partial<MotionState>, wish: typeof asked | null = asked) =>
    speedWords({ twist, motion: { factor: 1, reasons: [], mostLinear: 1, ...of } }, 1, wish);
  expect(told({})).toEqual({ text: '0.42 m/s, at most 1.00', tone: 'neutral' });
  expect(told({ factor: 0.5, reasons: ['obstacle-near', 'view-late'] })).toEqual({
    text: '0.42 m/s, at most 0.40: something is near',
    tone: 'warning',
  });
  expect(told({ factor: 0, reasons: ['drop-off'] })).toEqual({
    text: '0.42 m/s, held: the floor ahead is missing',
    tone: 'bad',
  });
  expect(told({ factor: 0.5, reasons: ['obstacle-near'] }, zeroTwist()).text).toBe(
    '0.42 m/s, slower: something is near',
  );
  expect(told({ mostLinear: 0.75, viewAgeMs: 310 }).text).toBe(
    '0.42 m/s, at most 0.75: what you see is 310 ms old',
  );
  // Who does not drive is not told what bounds another's wish.
  expect(told({ factor: 0.5, reasons: ['obstacle-near'] }, null).text).toBe('0.42 m/s, at most 1.00');
  expect(speedWords({ twist, motion: undefined }, 1.2, asked).text).toBe('0.42 m/s, at most 1.20');
});

test('every intervention has a reason in few words', () => {
  const twist = zeroTwist();
  for (const reason of interventions)
    expect(speedWords({ twist, motion: { ...motion, reasons: [reason] } }, 1, zeroTwist()).text).toMatch(
      /^0\.00 m\/s, slower: \S/,
    );
});
