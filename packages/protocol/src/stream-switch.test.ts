import { expect, test } from 'vitest';
import { ProtocolError } from './errors.ts';
import { decodeStreamSwitch } from './stream-switch.ts';

test('start and stop', () => {
  expect(decodeStreamSwitch('start')).toBe('start');
  expect(decodeStreamSwitch('stop')).toBe('stop');
});

test.each(['', 'Start', 'stop ', 'pause', '{"type":"stop"}'])('refuses %j', (text) => {
  expect(() => decodeStreamSwitch(text)).toThrow(ProtocolError);
});
