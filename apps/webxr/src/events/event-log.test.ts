import { describe, expect, test } from 'vitest';
import { AGAIN_MS, EventLog, MOST_EVENTS, MOST_TEXT, patternOf } from './event-log.ts';

function setUp() {
  const clock = { ms: 1_000_000 };
  const log = new EventLog(() => clock.ms);
  const texts = () => log.kept.value.events.map(({ text }) => text);
  return { clock, log, texts };
}

const words = (text: string) => ({ text, tone: 'warning' as const });

describe('the event log', () => {
  test('keeps what happened, when, with which robot and how severe', () => {
    const { log } = setUp();
    log.add({ text: 'Connected to Rover', tone: 'good' }, 'Rover');
    log.add({ text: 'Ann pressed STOP.', tone: 'bad' }, 'Rover');
    log.add({ text: 'Signaling connected', tone: 'neutral' }, null);
    expect(log.kept.value.dropped).toBe(0);
    expect(log.kept.value.events).toMatchObject([
      { atMs: 1_000_000, robot: 'Rover', severity: 'info', text: 'Connected to Rover', times: 1 },
      { robot: 'Rover', severity: 'error', text: 'Ann pressed STOP.' },
      { robot: null, severity: 'info' },
    ]);
  });

  test('is bounded: the oldest go, and it says how many', () => {
    const { log, texts } = setUp();
    const letters = (i: number) => [...String(i)].map((digit) => 'abcdefghij'[Number(digit)]).join('');
    for (let i = 0; i < MOST_EVENTS + 7; i++) log.add(words(letters(i)), null);
    expect(texts()).toHaveLength(MOST_EVENTS);
    expect(texts()[0]).toBe(letters(7));
    expect(log.kept.value.dropped).toBe(7);
    log.add(words('x'.repeat(5 * MOST_TEXT)), null);
    expect(texts().at(-1)).toHaveLength(MOST_TEXT);
    log.clear();
    expect(log.kept.value).toEqual({ events: [], dropped: 0 });
  });

  test('counts what happens again soon, whatever the numbers in it; later, or with another robot, it is anew', () => {
    const { clock, log, texts } = setUp();
    log.add(words('Slower: what you see is 310 ms old'), 'Rover');
    log.add(words('Refused'), 'Rover');
    clock.ms += 900;
    log.add(words('Slower: what you see is 1.2 s old'), 'Rover');
    expect(texts()).toEqual([
      'Slower: what you see is 310 ms old',
      'Refused',
      'Slower: what you see is 1.2 s old',
    ]);
    clock.ms += 100;
    log.add(words('Slower: what you see is 330 ms old'), 'Rover');
    expect(log.kept.value.events[0]).toMatchObject({
      ...{ text: 'Slower: what you see is 330 ms old', times: 2, atMs: 1_000_000, lastMs: 1_001_000 },
    });
    log.add(words('Refused'), 'Crawler');
    expect(texts()).toHaveLength(4);
    clock.ms += AGAIN_MS + 1;
    log.add(words('Refused'), 'Rover');
    expect(texts()).toHaveLength(5);
  });

  test('what has its place keeps it: nothing is counted across it', () => {
    const { log, texts } = setUp();
    for (const text of ['STOP', 'off', 'STOP']) log.mark(words(text), null);
    log.add(words('Refused'), null);
    log.mark(words('off'), null);
    log.add(words('Refused'), null);
    log.add(words('Refused'), null);
    expect(texts()).toEqual(['STOP', 'off', 'STOP', 'Refused', 'off', 'Refused']);
    expect(log.kept.value.events.at(-1)?.times).toBe(2);
  });

  test('what was kept before comes first', () => {
    const { log, texts } = setUp();
    log.add(words('now'), null);
    const earlier = { atMs: 1, lastMs: 1, times: 1, robot: null, severity: 'info' as const, text: 'before' };
    log.restore({ events: [earlier], dropped: 3 });
    expect(texts()).toEqual(['before', 'now']);
    expect(log.kept.value.dropped).toBe(3);
  });
});

test('numbers are no difference', () => {
  expect(patternOf('310 ms, 1.25 m/s')).toBe(patternOf('7 ms, 0,5 m/s'));
});
