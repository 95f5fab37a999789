import type { DiagnosticLevel, Diagnostics } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { ComponentReports } from './component-reports.ts';

const message = (timeMs: number, ...reports: [name: string, level: DiagnosticLevel, sinceMs: number][]) =>
  ({
    ...{ type: 'diagnostics', topic: '/diagnostics', timeMs },
    counts: { error: 0, warn: 0, stale: 0, ok: timeMs },
    reports: reports.map(([name, level, sinceMs]) => ({ name, level, message: '', sinceMs })),
  }) satisfies Diagnostics;

test('puts the messages together: by level, the newest first', () => {
  const components = new ComponentReports();
  components.take(message(100, ['imu', 'ok', 10], ['lidar', 'warn', 20]));
  components.take(message(200, ['motor', 'warn', 150], ['gripper', 'stale', 30], ['imu', 'error', 190]));
  expect(components.list()[0]?.reports.map(({ name }) => name)).toEqual(['imu', 'motor', 'lidar', 'gripper']);
  expect(components.list()[0]).toMatchObject({ timeMs: 200, counts: { ok: 200 }, recorded: false });
  components.take({ ...message(300), topic: '/played', recorded: true });
  expect(components.list()[1]).toMatchObject({ topic: '/played', recorded: true });
});

test('ignores what was overtaken', () => {
  const components = new ComponentReports();
  components.take(message(200, ['imu', 'ok', 150]));
  components.take(message(100, ['imu', 'error', 90], ['lidar', 'ok', 90]));
  expect(components.list()[0]).toMatchObject({
    timeMs: 200,
    counts: { ok: 200 },
    reports: [{ name: 'imu', level: 'ok' }, { name: 'lidar' }],
  });
});

test('keeps a bounded number of components and topics', () => {
  const components = new ComponentReports();
  for (let i = 0; i < 2000; i++) components.take(message(i, [`node ${i}`, 'ok', i]));
  for (let i = 0; i < 20; i++) components.take({ ...message(1), topic: `/${i}` });
  expect(components.list()).toHaveLength(8);
  expect(components.list()[0]?.reports).toHaveLength(1024);
});
