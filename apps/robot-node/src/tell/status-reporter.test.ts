import { decodeJson, encodeJson, robotToServiceCodec } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { type OwnStatus, StatusReporter } from './status-reporter.ts';

const status: OwnStatus = {
  state: 'free',
  holder: null,
  operators: 0,
  watchers: 0,
  maxOperators: 4,
  alarms: 0,
};
const { holder: _, ...plain } = status;
const driven: OwnStatus = { ...status, state: 'driven', holder: 's1', driver: 'Ada' };
const UNIX_MS = 1_800_000_000_000;

test('is told at once, and again only when something has changed', () => {
  const reporter = new StatusReporter(false);
  expect(reporter.next(status, 0, UNIX_MS)).toEqual({ ...plain, sinceMs: UNIX_MS });
  expect(reporter.next(status, 60_000, UNIX_MS + 60_000)).toBeNull();
  expect(reporter.next({ ...status, state: 'stopped' }, 60_001, UNIX_MS + 60_001)).toMatchObject({
    state: 'stopped',
    sinceMs: UNIX_MS + 60_001,
  });
});

test('is told every two seconds at most, with what is so then, and since when it is so', () => {
  const reporter = new StatusReporter(false);
  reporter.next(status, 0, UNIX_MS);
  expect(reporter.next(driven, 500, UNIX_MS + 500)).toBeNull();
  expect(reporter.next({ ...driven, operators: 1 }, 1999, UNIX_MS + 1999)).toBeNull();
  expect(reporter.next({ ...driven, operators: 2 }, 2000, UNIX_MS + 2000)).toMatchObject({
    state: 'driven',
    sinceMs: UNIX_MS + 500,
    operators: 2,
  });
});

test('counts the time of each driver anew', () => {
  const reporter = new StatusReporter(false);
  reporter.next(driven, 0, UNIX_MS);
  expect(reporter.next({ ...driven, holder: 's2' }, 5000, UNIX_MS + 5000)?.sinceMs).toBe(UNIX_MS + 5000);
});

test('is told again on a new connection', () => {
  const reporter = new StatusReporter(false);
  reporter.next(status, 0, UNIX_MS);
  reporter.reset();
  expect(reporter.next(status, 2000, UNIX_MS)).toMatchObject(plain);
});

test('has a battery in whole percent, within what the protocol allows', () => {
  const reporter = new StatusReporter(false);
  expect(reporter.next({ ...status, battery: 0.7849 }, 0, UNIX_MS)?.battery).toBe(0.78);
  expect(reporter.next({ ...status, battery: 0.7812 }, 5000, UNIX_MS)).toBeNull();
  for (const battery of [0, 0.004, 0.57, 0.999, 1]) {
    const told = new StatusReporter(false).next({ ...status, battery }, 0, UNIX_MS);
    if (told === null) throw new Error('nothing is told');
    const message = encodeJson(robotToServiceCodec, { type: 'robot.status', status: told });
    expect(decodeJson(robotToServiceCodec, message)).toMatchObject({ status: { battery: told.battery } });
  }
});

test('names who drives only where it is to, and nobody’s session ever', () => {
  expect(new StatusReporter(true).next(driven, 0, UNIX_MS)?.driver).toBe('Ada');
  const told = new StatusReporter(false).next(driven, 0, UNIX_MS);
  expect(told).toMatchObject({ state: 'driven' });
  expect(JSON.stringify(told)).not.toMatch(/Ada|s1/);
});
