import { expect, test } from 'vitest';
import { LastPictures, MOST_PICTURES } from './last-pictures.ts';

const drawn = (text: string) => (earlier: { text: string } | null) => {
  const picture = earlier ?? { text };
  picture.text = text;
  return picture;
};

test('keeps the last of each robot, and draws over the one before', () => {
  const pictures = new LastPictures<{ text: string }>();
  expect(pictures.of('a')).toBeNull();
  pictures.keep('a', drawn('first'), 10);
  const first = pictures.of('a')?.picture;
  pictures.keep('b', drawn('other'), 20);
  pictures.keep('a', drawn('second'), 30);
  expect(pictures.of('a')).toEqual({ picture: { text: 'second' }, drawnMs: 30 });
  expect(pictures.of('a')?.picture).toBe(first);
  expect(pictures.of('b')?.drawnMs).toBe(20);
});

test('forgets the robot that was seen longest ago', () => {
  const pictures = new LastPictures<{ text: string }>();
  for (let i = 0; i < MOST_PICTURES; i++) pictures.keep(`r${i}`, drawn('x'), i);
  pictures.keep('r0', drawn('again'), 1000);
  pictures.keep('new', drawn('x'), 1001);
  expect([pictures.of('r0'), pictures.of('r1'), pictures.of('new')].map((each) => each !== null)).toEqual([
    ...[true, false, true],
  ]);
});
