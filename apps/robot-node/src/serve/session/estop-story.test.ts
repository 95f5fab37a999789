import { expect, test } from 'vitest';
import { EstopStory } from './estop-story.ts';

test('the first who pressed STOP is told of, until it is released', () => {
  const story = new EstopStory(null);
  expect(story.told).toEqual({});
  story.changed(true, 'Ada');
  story.changed(true, 'Grace');
  expect(story.told).toEqual({ pressedBy: 'Ada' });
  story.changed(false, 'Grace');
  expect(story.told).toEqual({});
});

test('a latched start is told of until it is released, beside whoever presses STOP then', () => {
  const story = new EstopStory('unclean-exit');
  expect(story.told).toEqual({ start: 'unclean-exit' });
  story.changed(true, 'Ada');
  expect(story.told).toEqual({ pressedBy: 'Ada', start: 'unclean-exit' });
  story.changed(false);
  story.changed(true);
  expect(story.told).toEqual({});
});

test('a name is told without what turns the text round it', () => {
  const story = new EstopStory(null);
  story.changed(true, '\u202eAda');
  expect(story.told.pressedBy).toBe('Ada');
});
