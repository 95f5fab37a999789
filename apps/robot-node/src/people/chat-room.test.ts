import { expect, it } from 'vitest';
import { ChatRoom, chatLineFor } from './chat-room.ts';

const ada = { number: 4, name: 'Ada' };

it('keeps the last twenty lines, in order, and counts on', () => {
  const room = new ChatRoom();
  for (let n = 1; n <= 25; n++) room.say('s', ada, `line ${n}`, n);
  expect(room.lines.map(({ number }) => number)).toEqual(Array.from({ length: 20 }, (_, i) => i + 6));
});

it('tells each session how long ago, and whether it was its own', () => {
  const room = new ChatRoom();
  const line = room.say('s1', ada, 'Mind the step', 1000);
  const told = { type: 'chatLine', number: 1, from: ada, text: 'Mind the step' };
  expect(chatLineFor('s1', line, 4900)).toEqual({ ...told, yours: true, agoS: 3 });
  expect(chatLineFor('s2', line, 900)).toEqual({ ...told, yours: false, agoS: 0 });
});
