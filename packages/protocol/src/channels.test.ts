import { expect, test } from 'vitest';
import { channels } from './channels.ts';

test('no two channels share a label', () => {
  const labels = Object.values(channels).map(({ label }) => label);
  expect(new Set(labels).size).toBe(labels.length);
});
