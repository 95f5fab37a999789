import { expect, test } from 'vitest';
import { bannerWords } from './banner-words.ts';

const facts = {
  phase: 'live',
  ...{ robotListed: true, lastLoss: null, silentMs: 20 },
  ...{ maxOperators: null, lossDetail: null, gripped: false },
  ...{ gripLost: null, takenOverBy: null },
} as const;

test('nothing is said of a link that works, nor before there was one', () => {
  expect(bannerWords(facts)).toBe(null);
  expect(bannerWords({ ...facts, silentMs: 699 })).toBe(null);
  expect(bannerWords({ ...facts, phase: 'none', silentMs: 1e9 })).toBe(null);
  expect(bannerWords({ ...facts, phase: 'waiting' })).toBe(null);
  expect(bannerWords({ ...facts, phase: 'opening' })).toBe(null);
});

test('a silent robot: it stops, and the page keeps trying', () => {
  const banner = bannerWords({ ...facts, silentMs: 700 });
  expect(banner?.title).toBe('Connection lost');
  expect(banner?.text).toContain('stops by itself');
  expect(banner?.text).not.toContain('grip');
  // It is announced once, so it must not change every second.
  expect(bannerWords({ ...facts, silentMs: 16_000 })).toEqual(banner);
  expect(bannerWords({ ...facts, silentMs: 1000, gripped: true })?.text).toContain('Let go of the grip');
});

test('a session that ended: why, and whether the robot is there', () => {
  const lost = { ...facts, phase: 'waiting', lastLoss: 'robot-stopped' } as const;
  expect(bannerWords(lost)).toEqual({
    title: 'Not connected',
    text: 'The robot was shut down. Waiting for it to come back…',
    urgent: true,
  });
  expect(bannerWords({ ...lost, robotListed: false })?.title).toBe('The robot is offline');
  expect(bannerWords({ ...lost, phase: 'opening' })?.title).toBe('Not connected');
  expect(bannerWords({ ...lost, lastLoss: 'robot-full', maxOperators: 4 })?.text).toContain('4 operators');
});

test('a hand that holds on in vain is told so while the link works, without an alarm', () => {
  const lost = { ...facts, gripped: true, gripLost: 'path-lost' } as const;
  expect(bannerWords(lost)).toMatchObject({ title: 'Let go of the grip', urgent: false });
  expect(bannerWords({ ...lost, takenOverBy: 'Grace' })?.title).toBe('Taken over');
  // That nothing is heard comes first.
  expect(bannerWords({ ...lost, silentMs: 5000 })).toMatchObject({ title: 'Connection lost', urgent: true });
});

test('what a panel of its own says is not said twice', () => {
  expect(bannerWords({ ...facts, phase: 'waiting', lastLoss: 'not-granted' })).toBe(null);
});
