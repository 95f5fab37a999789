import type { RobotAbout } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { aboutWords } from './about-words.ts';

const about: RobotAbout = { type: 'about', drives: true, shows: 'sensors', recorded: false };

test('nothing is said of a robot that shows what is there, nor of one that does not say', () => {
  expect(aboutWords(null)).toEqual([]);
  expect(aboutWords(about)).toEqual([]);
  expect(aboutWords({ ...about, shows: 'simulation' })).toEqual([]);
});

test('a playback and a recording are said, each by itself', () => {
  const texts = (given: Partial<RobotAbout>) => aboutWords({ ...about, ...given }).map(({ text }) => text);
  expect(texts({ shows: 'files' })).toEqual([expect.stringContaining('Playback')]);
  expect(texts({ recorded: true })).toEqual([expect.stringContaining('recorded')]);
  expect(texts({ shows: 'files', recorded: true })).toHaveLength(2);
});
