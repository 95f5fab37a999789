import { decodeJson, encodeJson, robotToServiceCodec } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { BETWEEN_MS, StatusReporter } from './status-reporter.ts';

const status = { estop: false, moving: false, driven: false, operators: 0, maxOperators: 4, alarms: 0 };

test('is said at once, and again only when something has changed', () => {
  const reporter = new StatusReporter(false);
  expect(reporter.next(status, 0)).toEqual(status);
  expect(reporter.next(status, 60_000)).toBeNull();
  expect(reporter.next({ ...status, estop: true }, 60_001)).toMatchObject({ estop: true });
});

test('is said once a second at most, with what is so then', () => {
  const reporter = new StatusReporter(false);
  reporter.next(status, 0);
  expect(reporter.next({ ...status, moving: true }, BETWEEN_MS - 1)).toBeNull();
  expect(reporter.next({ ...status, driven: true }, BETWEEN_MS)).toEqual({ ...status, driven: true });
});

test('is said again on a new connection', () => {
  const reporter = new StatusReporter(false);
  reporter.next(status, 0);
  reporter.reset();
  expect(reporter.next(status, BETWEEN_MS)).toEqual(status);
});

test('says a battery in whole percent, within what the protocol allows', () => {
  const reporter = new StatusReporter(false);
  expect(reporter.next({ ...status, battery: 0.7849 }, 0)?.battery).toBeCloseTo(0.78, 12);
  expect(reporter.next({ ...status, battery: 0.7812 }, 5000)).toBeNull();
  for (const battery of [0, 0.004, 0.57, 0.999, 1]) {
    const said = new StatusReporter(false).next({ ...status, battery }, 0);
    const message = encodeJson(robotToServiceCodec, { type: 'robot.status', status: said ?? status });
    expect(decodeJson(robotToServiceCodec, message)).toMatchObject({ status: { battery: said?.battery } });
  }
});

test('says who drives only where it is to', () => {
  const driven = { ...status, driven: true, driver: 'Ada' };
  expect(new StatusReporter(true).next(driven, 0)).toEqual(driven);
  expect(new StatusReporter(false).next(driven, 0)).toEqual({ ...status, driven: true });
});
