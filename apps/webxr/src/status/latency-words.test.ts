import { expect, test } from 'vitest';
import type { LatencyEntry } from '../latency/latency-log.ts';
import {
  cloudStageWords,
  frameTotalWords,
  lastTestWords,
  networkWords,
  testStageWords,
  testsWords,
} from './latency-words.ts';

const entry = (mtpMs: number | null): LatencyEntry => {
  const report = {
    id: 1,
    startedAtMs: 0,
    mtpMs: mtpMs ?? 0,
    firstMs: 1,
    arrivedMs: 1,
    points: 1,
    totalPoints: 1,
  };
  return {
    ...{ atMs: 0, stages: null, failure: mtpMs === null ? 'timeout' : null },
    report: mtpMs === null ? null : { ...report, frameNumber: 1, robot: null },
  };
};

test('what is not live or not known has no figure', () => {
  expect(cloudStageWords(null).map(({ text, ms }) => [text, ms])).toEqual(Array(6).fill(['–', null]));
  expect(testStageWords(null).map(({ text }) => text)).toEqual(Array(4).fill('–'));
  expect(frameTotalWords(null)).toBe('Cloud, capture to display: –');
  expect(networkWords(null)).toBe('Network alone, one way: – (half the shortest round trip)');
});

test('each stage has its milliseconds', () => {
  const stages = {
    frames: 9,
    framesSeen: 9,
    firstPacketMs: 30.4,
    furtherPacketsMs: 5,
    drawMs: 12,
    totalMs: 47.4,
  };
  const whole = { captureMs: null, encodeMs: null, wayMs: 30.4, furtherMs: 5, decodeMs: null, drawMs: 12 };
  const shown = cloudStageWords(whole).map(({ text }) => text);
  expect(shown).toEqual(['–', '–', '30 ms', '5.0 ms', '–', '12 ms']);
  expect(cloudStageWords(whole)[2]?.name).toBe('Robot and network together');
  const split = cloudStageWords({ ...whole, captureMs: 8, encodeMs: 4, wayMs: 18.4 });
  expect(split[2]).toEqual({ name: 'Waiting at the robot, and network', ms: 18.4, text: '18 ms' });
  expect(frameTotalWords(stages)).toBe('Cloud, capture to display: 47 ms');
  expect(networkWords(7)).toContain('about 3.5 ms');
});

test('tests are summed up', () => {
  expect([testsWords([]), lastTestWords(undefined)]).toEqual(['', 'No latency test yet.']);
  expect(testsWords([entry(90)])).toBe('1 test');
  expect(testsWords([entry(90), entry(null), entry(70), entry(120)])).toBe(
    '3 tests: median 90 ms, 70 ms to 120 ms; 1 failed',
  );
  expect(testsWords([entry(null)])).toBe('1 failed');
  expect(lastTestWords(entry(90))).toBe('Last test, motion to photon: 90 ms; its stages are unknown');
  expect(lastTestWords(entry(null))).toMatch(/^Last test: No green cloud arrived/);
});
