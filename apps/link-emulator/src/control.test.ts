import { monotonicMs, UdpLink } from '@farpoint/link-emulator';
import { constantCapacity, idealProfile } from '@farpoint/network-sim';
import { expect, onTestFinished, test } from 'vitest';
import { ZodError } from 'zod';
import { control } from './control.ts';

const initial = { up: idealProfile, down: idealProfile };
function open(): UdpLink {
  const link = new UdpLink({ up: { profile: idealProfile }, down: { profile: idealProfile }, seed: 1 });
  onTestFinished(() => link.close());
  return link;
}

test('a message changes the members and direction that it names', () => {
  const link = open();
  control(link, { type: 'set', direction: 'up', rateMbps: 3, delayMs: 7, queueMs: 50 }, initial);
  expect(link.models.up.profile).toEqual({
    ...idealProfile,
    capacity: { steps: [{ atMs: 0, mbps: 3 }], periodMs: null },
    delayMs: 7,
    queue: { ms: 50 },
  });
  expect(link.models.down.profile).toBe(idealProfile);
  control(link, { type: 'blackhole', direction: 'both', active: true }, initial);
  expect(link.models.down.offer(100, monotonicMs(), 0)).toBe('blackhole');
});

test('an invalid message leaves the link unchanged', () => {
  const link = open();
  expect(() => control(link, { type: 'set', direction: 'sideways' }, initial)).toThrow(ZodError);
  expect(() => control(link, { type: 'set', direction: 'up', loss: 3 }, initial)).toThrow(
    'is not a probability',
  );
  expect(link.models.up.profile).toBe(idealProfile);
});

test('a reset restores the options', () => {
  const link = open();
  const options = { up: { ...idealProfile, capacity: constantCapacity(3) }, down: idealProfile };
  control(link, { type: 'set', direction: 'both', rateMbps: 10, loss: 0.5 }, options);
  control(link, { type: 'reset' }, options);
  expect(link.models.up.profile).toBe(options.up);
  expect(link.models.down.profile).toBe(options.down);
});
