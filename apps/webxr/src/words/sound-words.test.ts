import { describe, expect, test } from 'vitest';
import { heardWords, voiceWords } from './sound-words.ts';

describe('what is heard of the robot', () => {
  const live = { wanted: true, microphone: { state: 'live' }, playing: true, refused: false } as const;

  test.each([
    [{ ...live, wanted: false }, 'off'],
    [{ ...live, microphone: undefined }, 'waiting'],
    [{ ...live, microphone: { state: 'starting' } }, 'waiting'],
    [{ ...live, microphone: { state: 'muted' } }, 'waiting'],
    [{ ...live, microphone: { state: 'slow-link' } }, 'failed'],
    [{ ...live, playing: false }, 'waiting'],
    [{ ...live, refused: true, playing: false }, 'failed'],
    [live, 'live'],
  ] as const)('%o is %s', (facts, state) => expect(heardWords(facts).state).toBe(state));

  test('a failure has the robot’s reason', () => {
    const microphone = { state: 'failed', detail: 'unplugged' } as const;
    expect(heardWords({ ...live, microphone }).text).toBe('No sound: unplugged');
  });
});

describe('the operator’s voice', () => {
  const sending = { held: true, sending: true, failure: null };

  test('the robot hears it only if the robot says so', () => {
    expect(voiceWords(sending, { state: 'closed' }).state).toBe('waiting');
    expect(voiceWords(sending, { state: 'open' })).toMatchObject({
      state: 'live',
      text: 'The robot hears you',
    });
    expect(voiceWords({ ...sending, held: false, sending: false }, { state: 'open' }).state).toBe('off');
  });

  test('it says why it is not heard', () => {
    expect(voiceWords(sending, { state: 'not-driving' }).text).toContain('driver');
    expect(voiceWords(sending, { state: 'failed', detail: 'busy' }).text).toBe('Not heard: busy');
    const refused = { held: true, sending: false, failure: { reason: 'refused', detail: '' } } as const;
    expect(voiceWords(refused, { state: 'closed' }).text).toContain('Allow it');
  });
});
