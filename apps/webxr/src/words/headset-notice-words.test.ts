import { expect, test } from 'vitest';
import { choiceWords, type HeadsetNoticeFacts, headsetNotice } from './headset-notice-words.ts';
import { viewNotice } from './headset-words.ts';

const quiet: HeadsetNoticeFacts = {
  failure: null,
  banner: null,
  obstacle: null,
  stop: null,
  held: null,
  asked: null,
  menuOpen: false,
  choice: null,
  notice: null,
  view: 'first-person',
  driveHand: 'right',
};
const banner = { title: 'The robot is gone', text: 'The robot stops by itself.', urgent: true };
const notice = { text: 'Someone else is driving.', tone: 'warning' } as const;
const held = { text: 'Held: something is in the way', tone: 'bad' } as const;
const stop = { why: 'Bo pressed STOP.', release: 'Hold the release control.', mayRelease: true, heard: true };

test('says what the flat page says: what holds, and what passes', () => {
  expect(headsetNotice(quiet)).toEqual({ standing: null, passing: null, hint: null });
  expect(headsetNotice({ ...quiet, banner, notice })).toEqual({
    standing: { title: banner.title, text: banner.text, tone: 'bad' },
    passing: notice,
    hint: null,
  });
  expect(headsetNotice({ ...quiet, held }).standing).toEqual({ title: null, ...held });
});

test('a lost link matters more than the stop, and the stop more than what holds the robot', () => {
  expect(headsetNotice({ ...quiet, banner, stop, held }).standing?.title).toBe(banner.title);
  const failure = { title: 'The graphics system was reset', text: 'The picture returns.' };
  expect(headsetNotice({ ...quiet, failure, banner }).standing?.title).toBe(failure.title);
  expect(headsetNotice({ ...quiet, stop, held }).standing?.title).toBe('Emergency stop');
});

test('the stop says who pressed it, and how hands in the headset release it', () => {
  const text = headsetNotice({ ...quiet, stop }).standing?.text;
  expect(text).toMatch(/^Bo pressed STOP\. .*open both hands.*hold a trigger for one second/);
  expect(text).not.toContain('control');
});

test('a stop that this operator may not release says who releases it', () => {
  const release = 'It is released there, at the robot, and nowhere else.';
  const text = headsetNotice({ ...quiet, stop: { ...stop, release, mayRelease: false, heard: true } })
    .standing?.text;
  expect(text).toBe(`Bo pressed STOP. ${release}`);
});

test('what is answered on the page says so: its buttons are not in the headset', () => {
  const obstacle = { title: 'The robot does not admit you', text: 'Ask for a grant.' };
  expect(headsetNotice({ ...quiet, obstacle }).standing).toMatchObject({
    title: obstacle.title,
    text: expect.stringMatching(/^Ask for a grant\. .*leave VR/),
  });
});

test('nothing is said twice, and no good news below a loss', () => {
  const connected = { text: 'Connected to Ada', tone: 'good' } as const;
  expect(headsetNotice({ ...quiet, banner, notice: connected }).passing).toBeNull();
  expect(headsetNotice({ ...quiet, notice: connected }).passing).toBe(connected);
  const same = { text: banner.text, tone: 'warning' } as const;
  expect(headsetNotice({ ...quiet, banner, notice: same }).passing).toBeNull();
});

test('a view that begins says what the hands do in it', () => {
  const begun = { text: viewNotice('tabletop'), tone: 'neutral' } as const;
  const shown = headsetNotice({ ...quiet, view: 'tabletop', driveHand: 'left', notice: begun });
  expect(shown.passing).toBe(begun);
  expect(shown.hint).toContain('squeeze left: drive');
  expect(headsetNotice({ ...quiet, view: 'first-person', notice: begun }).hint).toBeNull();
});

test('without a robot: which press chooses one, or why there is none', () => {
  const facts = {
    next: { name: 'Ada' },
    others: false,
    signaling: 'ready',
    host: 'x.org',
    driveHand: 'left',
  } as const;
  const choice = choiceWords(facts);
  expect(choice.text).toBe('Press the left stick to connect to Ada.');
  expect(headsetNotice({ ...quiet, choice }).standing).toEqual({ title: 'No robot is chosen', ...choice });
  expect(choiceWords({ ...facts, others: true }).text).toBe(`${choice.text} The menu lists all robots.`);
  expect(choiceWords({ ...facts, next: null }).text).toContain('No robots are online');
  expect(choiceWords({ ...facts, next: null, signaling: 'waiting' }).text).toContain(
    'x.org cannot be reached',
  );
});

test('a request says that the menu answers it, below all that keeps the robot from driving', () => {
  const asked = 'Bo asks to drive';
  expect(headsetNotice({ ...quiet, asked }).standing).toEqual({
    title: null,
    text: 'Bo asks to drive. Answer in the menu.',
    tone: 'warning',
  });
  expect(headsetNotice({ ...quiet, asked, held }).standing?.text).toBe(held.text);
});

test('in the menu a trigger chooses, so the stop says to close that first; who may not release it reads who may', () => {
  expect(headsetNotice({ ...quiet, stop, menuOpen: true }).standing?.text).toContain('close the menu');
  const others = { ...stop, mayRelease: false };
  expect(headsetNotice({ ...quiet, stop: others, menuOpen: true }).standing?.text).not.toContain('menu');
});

test('settings are not in the headset: where only they help, the sign says so', () => {
  const facts = { next: null, others: false, host: 'example.org', driveHand: 'right' } as const;
  expect(choiceWords({ ...facts, signaling: 'refused' }).text).toContain('leave VR');
  expect(choiceWords({ ...facts, signaling: 'ready' }).text).not.toContain('leave VR');
});
