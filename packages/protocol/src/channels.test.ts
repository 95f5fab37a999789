import { expect, test } from 'vitest';
import { channels } from './channels.ts';

test('no two channels share a label', () => {
  const labels = Object.values(channels).map(({ label }) => label);
  expect(new Set(labels).size).toBe(labels.length);
});

test('what the robot opens never asks for 0 retransmissions: werift would make it reliable', () => {
  for (const channel of Object.values(channels)) {
    if (channel.openedBy === 'robot') expect(channel).not.toHaveProperty('maxRetransmits');
  }
});
