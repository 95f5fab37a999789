import { expect, test } from 'vitest';
import { type HeadsetNoticeFacts, headsetNotice } from './headset-notice-words.ts';

const quiet: HeadsetNoticeFacts = {
  ...{ failure: null, banner: null, obstacle: null, held: null, stop: null, asked: null, notice: null },
};
const banner = { title: 'Connection lost', text: 'The robot stops by itself.', urgent: true };
const notice = { text: 'Someone else is driving.', tone: 'warning' as const };
const held = { text: 'Held: something is in the way', tone: 'bad' as const };

test('says what the flat page says: what holds, and what passes', () => {
  expect(headsetNotice(quiet)).toEqual({ standing: null, passing: null });
  expect(headsetNotice({ ...quiet, banner, notice })).toEqual({
    standing: { title: banner.title, text: banner.text, tone: 'bad' },
    passing: notice,
  });
  expect(headsetNotice({ ...quiet, held }).standing).toEqual({ title: null, ...held });
});

test('a lost link matters more than the stop, and the stop more than what holds the robot', () => {
  const stop = { atRobot: false, by: 'robot' } as const;
  expect(headsetNotice({ ...quiet, banner, stop, held }).standing?.title).toBe(banner.title);
  const { standing } = headsetNotice({ ...quiet, stop, held });
  expect(standing).toMatchObject({ title: 'STOP is on (by the robot)', tone: 'bad' });
  expect(standing?.text).toContain('hold a trigger for one second');
  const atRobot = headsetNotice({ ...quiet, stop: { atRobot: true, by: null } }).standing;
  expect(atRobot?.text).toBe('It can be released at the robot only.');
});

test('nothing is said twice', () => {
  const same = { text: banner.text, tone: 'warning' as const };
  expect(headsetNotice({ ...quiet, banner, notice: same }).passing).toBeNull();
});

test('what another operator asks stands until it is answered, but for what holds the robot', () => {
  const asked = 'Ada asks to drive';
  expect(headsetNotice({ ...quiet, asked }).standing).toMatchObject({ title: asked, tone: 'warning' });
  expect(headsetNotice({ ...quiet, asked, held }).standing?.text).toBe(held.text);
});
