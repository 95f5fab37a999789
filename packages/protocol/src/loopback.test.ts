import { expect, it } from 'vitest';
import { isLoopbackHost } from './loopback.ts';

it('knows this machine by its own names only', () => {
  for (const host of ['localhost', '127.0.0.1', '127.8.9.10', '::1', '[::1]'])
    expect(isLoopbackHost(host), host).toBe(true);
  for (const host of [
    '',
    '127.',
    '127.0.0.1.evil.example',
    'localhost.evil.example',
    '1.127.0.0',
    '10.0.0.1',
    '::',
  ])
    expect(isLoopbackHost(host), host).toBe(false);
});
