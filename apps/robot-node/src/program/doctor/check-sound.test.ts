import { expect, test } from 'vitest';
import { judgeSound } from './check-sound.ts';

const fault = { sentence: 'the microphone does not work: busy', remedy: 'check the device' };

test('a device that works says how soon, and a slow one is a warning', () => {
  const trials = [
    { device: 'microphone', fault: null, startedMs: 300 },
    { device: 'loudspeaker', fault: null, startedMs: 2500 },
  ] as const;
  expect(judgeSound(trials, false)).toMatchObject([
    { verdict: 'ok', detail: 'the microphone works: ready after 0.3 s' },
    { verdict: 'warn' },
  ]);
});

test('one that does not says why and what to do', () => {
  const [failed, silent] = judgeSound(
    [
      { device: 'microphone', fault, startedMs: null },
      { device: 'loudspeaker', fault: null, startedMs: null },
    ],
    true,
  );
  expect(failed).toMatchObject({ detail: fault.sentence });
  expect(failed?.remedy).toMatch(/^stop the running robot.*check the device$/);
  expect(silent?.detail).toBe('the loudspeaker did not start');
});
