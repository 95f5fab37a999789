import { expect, test } from 'vitest';
import { channels } from './channels.ts';

test('no two channels share a label', () => {
  const labels = Object.values(channels).map(({ label }) => label);
  expect(new Set(labels).size).toBe(labels.length);
});

test('the robot never opens a channel with 0 retransmissions: werift would make it reliable', () => {
  for (const channel of Object.values(channels)) {
    if (channel.openedBy === 'robot') expect(channel).not.toHaveProperty('maxRetransmits');
  }
});
