import { expect, test } from 'vitest';
import { tracesUrl } from './spans.ts';
import { robotOf } from './testing/robot-of.ts';

test('spans go nowhere by default', () => {
  expect(robotOf([]).spans).toBe(undefined);
});

test('an endpoint takes spans at its traces path', () => {
  const { spans } = robotOf(['--id', 'r1', '--otlp-endpoint', 'http://localhost:4318']);
  expect(spans).toMatchObject({ url: 'http://localhost:4318/v1/traces', robotId: 'r1' });
  expect(tracesUrl('https://host/otlp/')).toBe('https://host/otlp/v1/traces');
  expect(tracesUrl('https://host/v1/traces')).toBe('https://host/v1/traces');
});

test.each([
  ['ftp://host', /must be an http:\/\/ or https:\/\/ address/],
  ['localhost', /must be an http:\/\/ or https:\/\/ address/],
  ['http://user:secret@host', /must have no user, password, query or fragment/],
  ['http://host/?token=secret', /must have no user, password, query or fragment/],
])('%s is refused', (endpoint, message) => {
  expect(() => robotOf(['--otlp-endpoint', endpoint])).toThrow(message);
});
