import { type CommandRejected, decodeJson, encodeJson, robotSessionCodec } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { RejectionReporter } from './rejection-reporter.ts';

const stale = { reason: 'stale', detail: '200 ms late' } as const;

test('reports the first refusal at once, with its number', () => {
  expect(new RejectionReporter().add(stale, 7, 0)).toEqual({
    type: 'rejected',
    sequence: 7,
    reason: 'stale',
    detail: '200 ms late',
    count: 1,
  });
});

test('combines a flood into ten reports a second, and loses no refusal', () => {
  const reporter = new RejectionReporter();
  const reports: CommandRejected[] = [];
  for (let t = 0; t < 1000; t++) {
    const report = reporter.add(stale, t, t);
    if (report !== null) reports.push(report);
  }
  expect(reports).toHaveLength(10);
  expect(reporter.nextDueMs).toBe(1000);
  expect(reporter.due(999)).toEqual([]);
  const rest = reporter.due(1000);
  expect(rest).toHaveLength(1);
  expect(rest[0]?.sequence).toBe(999);
  expect([...reports, ...rest].reduce((sum, { count }) => sum + count, 0)).toBe(1000);
  expect(reporter.nextDueMs).toBeNull();
});

test('each reason has its own limit of ten', () => {
  const reporter = new RejectionReporter();
  expect(reporter.add(stale, 1, 0)).not.toBeNull();
  expect(reporter.add({ reason: 'repeated', detail: '' }, 1, 0)).not.toBeNull();
  expect(reporter.add(stale, 2, 1)).toBeNull();
});

test('without a readable sequence number, the report has none', () => {
  const report = new RejectionReporter().add({ reason: 'malformed', detail: 'not valid JSON' }, undefined, 0);
  expect(report).not.toHaveProperty('sequence');
});

test('a report is a valid session message, however long its detail is', () => {
  const report = new RejectionReporter().add({ reason: 'malformed', detail: 'x'.repeat(9999) }, 1, 0);
  expect(report).not.toBeNull();
  const text = encodeJson(robotSessionCodec, report as CommandRejected);
  expect(decodeJson(robotSessionCodec, text)).toEqual(report);
});
