import { expect, test } from 'vitest';
import { signalingEndpoint } from './signaling-endpoint.ts';

test.each([
  ['ws://127.0.0.1:3000', 'ws://127.0.0.1:3000/robot'],
  ['ws://127.0.0.1:3000/', 'ws://127.0.0.1:3000/robot'],
  ['wss://host/base', 'wss://host/base/robot'],
  ['wss://host/base/', 'wss://host/base/robot'],
  ['wss://host/a/b//', 'wss://host/a/b/robot'],
  ['wss://host/robot', 'wss://host/robot'],
  ['wss://host/base/operator', 'wss://host/base/robot'],
  ['wss://host/robots', 'wss://host/robots/robot'],
  ['wss://host/base?a=1#b', 'wss://host/base/robot?a=1'],
])('robots of %s connect to %s', (service, url) => {
  expect(signalingEndpoint(service, 'robot').href).toBe(url);
});

test('whether it works is told beside it', () => {
  expect(signalingEndpoint('https://host/base/robot', 'healthz').href).toBe('https://host/base/healthz');
});
