import { expect, test } from 'vitest';
import { receiverFor } from './video-receiver.ts';

const none = { track: false, native: false, webcodecs: false };

test('what is asked for, where the browser can; else the best that it can', () => {
  const all = { track: true, native: true, webcodecs: true };
  expect(receiverFor(null, all)).toBe('track');
  expect(receiverFor('webcodecs', all)).toBe('webcodecs');
  expect(receiverFor('native', all)).toBe('native');
  // Firefox, and an old browser.
  expect(receiverFor('webcodecs', { ...none, native: true })).toBe('native');
  expect(receiverFor(null, { ...none, native: true })).toBe('native');
  expect(receiverFor('track', none)).toBe(null);
});
