import { commandStages, type FrameStage, frameStages, type StageSummary } from '@farpoint/operator';
import { expect, test } from 'vitest';
import { texts } from './language.ts';
import { stageLine, stageLines, stagesCsv, totalWords, unknownWords } from './stage-words.ts';

const of = (p50: number, p95 = 2 * p50) => ({ p50, p95, p99: p95, max: p95 });
const KNOWN: StageSummary<FrameStage> = {
  rows: 60,
  untold: 0,
  clockless: 0,
  totalMs: of(240.2, 310),
  stages: { capture: of(4), encode: of(12), queue: of(20), link: of(180.4), decode: of(6), draw: of(18) },
  worst: 'link',
};
const UNTOLD: StageSummary<FrameStage> = {
  ...KNOWN,
  untold: 60,
  stages: { ...KNOWN.stages, capture: null, encode: null, queue: null, link: null },
  worst: 'draw',
};

test('one line: how late, and what takes longest', () => {
  expect(stageLine(KNOWN)).toBe('240 ms · link 180 ms');
  expect(stageLine({ ...KNOWN, worst: 'queue' })).toBe('240 ms · robot’s queue 20 ms');
  expect(stageLine({ ...KNOWN, rows: 0 })).toBe(null);
});

test('while the link’s time is unknown, nothing is said to take longest', () => {
  expect(stageLine(UNTOLD)).toBe('240 ms');
  expect(stageLine({ ...UNTOLD, totalMs: null })).toBe('age unknown');
});

test('a line for each stage, with a dash for what is not known', () => {
  expect(
    stageLines(KNOWN, texts().timing.frameStages).map(({ name, median, p95 }) => [name, median, p95]),
  ).toEqual([
    ['capture', '4.0 ms', '8.0 ms'],
    ['encoding', '12 ms', '24 ms'],
    ['robot’s queue', '20 ms', '40 ms'],
    ['link', '180 ms', '361 ms'],
    ['decoding', '6.0 ms', '12 ms'],
    ['drawing', '18 ms', '36 ms'],
  ]);
  const lines = stageLines(UNTOLD, texts().timing.frameStages);
  expect(lines.map(({ median }) => median)).toEqual(['–', '–', '–', '–', '6.0 ms', '18 ms']);
  expect(lines.map(({ share }) => share)).toEqual([0, 0, 0, 0, 0.25, 0.75]);
  expect(lines.filter(({ isWorst }) => isWorst).map(({ name }) => name)).toEqual(['drawing']);
  expect(Object.keys(texts().timing.frameStages)).toEqual([...frameStages]);
  expect(Object.keys(texts().timing.commandStages)).toEqual([...commandStages]);
});

test('says why something is not known', () => {
  expect(unknownWords(KNOWN)).toBe('');
  expect(unknownWords(UNTOLD)).toBe('The robot has told its own times of none.');
  expect(unknownWords({ ...KNOWN, untold: 3 })).toBe('The robot has told its own times of all but 3 of 60.');
  expect(unknownWords({ ...KNOWN, clockless: 2 })).toMatch(/^The link is unknown until/);
  expect(totalWords('Clouds', KNOWN.totalMs)).toBe('Clouds: 240 ms, 95 of 100 within 310 ms');
  expect(totalWords('Commands', null)).toBe('Commands: –');
});

test('a table with a row for each frame, and nothing where nothing is known', () => {
  const took = { capture: 4, encode: 12, queue: 20, link: 180.4004, decode: 6, draw: 18 };
  const unknown = { capture: null, encode: null, queue: null, link: null, decode: 6, draw: 18 };
  const rows = [
    { number: 7, endedMs: 1000, totalMs: 240.4004, stages: took, told: true },
    { number: 8, endedMs: 1033.5, totalMs: null, stages: unknown, told: false },
  ];
  expect(stagesCsv(frameStages, rows, Date.UTC(2026, 10, 30)).split('\r\n')).toEqual([
    'time,number,total_ms,capture_ms,encode_ms,queue_ms,link_ms,decode_ms,draw_ms',
    '2026-11-30T00:00:01.000Z,7,240.400,4.000,12.000,20.000,180.400,6.000,18.000',
    '2026-11-30T00:00:01.033Z,8,,,,,,6.000,18.000',
    '',
  ]);
});
