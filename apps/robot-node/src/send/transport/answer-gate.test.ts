import { expect, it } from 'vitest';
import { AnswerGate } from './answer-gate.ts';

it('takes one answer per offer', () => {
  const gate = new AnswerGate();
  expect(gate.judge('early')).toBe('unasked');
  gate.onOffer();
  expect(gate.judge('a')).toBe('taken');
  expect(gate.judge('b')).toBe('unasked');
  gate.onOffer();
  expect(gate.judge('b')).toBe('taken');
});

it('does not take a repeated answer, even for the next offer', () => {
  const gate = new AnswerGate();
  gate.onOffer();
  gate.judge('a');
  expect(gate.judge('a')).toBe('repeated');
  gate.onOffer();
  expect(gate.judge('a')).toBe('repeated');
  expect(gate.judge('b')).toBe('taken');
});
