import fc from 'fast-check';
import { expect, test } from 'vitest';
import { type CandidateMapper, mapMessage } from './signaling-messages.ts';

const mapper: CandidateMapper = {
  sdp: (side, sdp) => `${side} ${sdp}`,
  candidate: (side, candidate) => (candidate === 'drop' ? null : `${side} ${candidate}`),
};
const map = (message: unknown, from: 'robot' | 'operator' = 'robot'): unknown => {
  const text = mapMessage(JSON.stringify(message), from, mapper);
  return text === null ? null : JSON.parse(text);
};

test("Farpoint's offers, answers and candidates are mapped, and keep their other members", () => {
  expect(map({ type: 'session.offer', session: 's1', sdp: 'v=0' })).toEqual({
    type: 'session.offer',
    session: 's1',
    sdp: 'robot v=0',
  });
  expect(map({ type: 'session.answer', session: 's1', sdp: 'v=0' }, 'operator')).toMatchObject({
    sdp: 'operator v=0',
  });
  const candidate = { candidate: 'c', sdpMid: '0', sdpMLineIndex: null };
  expect(map({ type: 'session.candidate', session: 's1', candidate })).toEqual({
    type: 'session.candidate',
    session: 's1',
    candidate: { ...candidate, candidate: 'robot c' },
  });
});

test('omits a message whose candidate is left out; passes the end of candidates', () => {
  expect(map({ type: 'session.candidate', session: 's1', candidate: { candidate: 'drop' } })).toBeNull();
  expect(map({ type: 'candidate', candidate: 'drop', robotId: 1 })).toBeNull();
  const end = { type: 'session.candidate', session: 's1', candidate: { candidate: '' } };
  expect(map(end)).toEqual(end);
});

test('maps the reference system’s messages by the owner of their candidates', () => {
  expect(map({ type: 'register', name: 'Diane', sdpOffer: 'v=0' })).toEqual({
    type: 'register',
    name: 'Diane',
    sdpOffer: 'robot v=0',
  });
  expect(map({ type: 'answer', robotId: 0, sdpAnswer: 'v=0' }, 'operator')).toMatchObject({
    sdpAnswer: 'operator v=0',
  });
  expect(map({ type: 'sdpAnswer', sdpAnswer: 'v=0' }, 'operator')).toMatchObject({
    sdpAnswer: 'operator v=0',
  });
  expect(map({ type: 'candidate', robotId: 0, candidate: 'c' }, 'operator')).toMatchObject({
    candidate: 'operator c',
  });
  const robot = {
    id: 0,
    name: 'Diane',
    sdpOffer: 'o',
    sdpAnswer: null,
    robotCandidates: ['a', 'drop'],
    clientCandidates: ['b'],
  };
  const mapped = {
    ...robot,
    sdpOffer: 'robot o',
    robotCandidates: ['robot a'],
    clientCandidates: ['operator b'],
  };
  expect(map({ type: 'robots', robots: [robot] })).toEqual({ type: 'robots', robots: [mapped] });
  expect(map({ type: 'register', robot })).toEqual({ type: 'register', robot: mapped });
});

test('passes everything else as the same text', () => {
  fc.assert(
    fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
      expect(mapMessage(text, 'robot', mapper)).toBe(text);
    }),
    { seed: 6 },
  );
  const robots = '{"type":"robots",  "robots":[]}';
  expect(JSON.parse(mapMessage(robots, 'robot', mapper) ?? '')).toEqual(JSON.parse(robots));
});
