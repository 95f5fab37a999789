import type { SourceFigures } from '@farpoint/operator';
import { expect, test } from 'vitest';
import type { VideoStats } from '../take/video/video-figures.ts';
import { videoReport } from './video-report.ts';

const none = { superseded: 0, late: 0, overflow: 0, removed: 0 };
const source = (name: string, more: Partial<SourceFigures> = {}): SourceFigures => ({
  ...{ source: name, state: 'in-step', intervalMs: 33, behindMs: 0, presented: 200, waits: 0, drops: none },
  ...more,
});
const stats = (more: Partial<VideoStats> = {}): VideoStats => ({
  ...{ synchronised: true, presentations: 200, heldMs: null, receiver: 'native', undecoded: {}, videos: [] },
  ...{ undated: 0, sources: [source('video:0'), source('video:1')] },
  spreadMs: { p50: 0, p95: 0.4, p99: 33, max: 40 } as VideoStats['spreadMs'],
  ...more,
});

test('says whether what is shown was captured together, whom it waited for and what it dropped', () => {
  const drops = { ...none, superseded: 7, late: 2 };
  const sources = [
    source('video:0'),
    source('video:1', { waits: 3, drops }),
    source('cloud', { state: 'apart' }),
  ];
  expect(videoReport(stats({ sources }), ['Front', 'Rear'])).toEqual({
    ...{ summary: 'In step within 0 ms', tone: 'neutral' },
    lines: [
      { name: 'Front', text: 'in step', tone: 'neutral' },
      {
        ...{ name: 'Rear', tone: 'neutral' },
        text: 'in step · waited for in vain 3× (1.5 %) · 7 replaced by a newer one · 2 too late',
      },
      { name: 'Cloud', text: 'by itself', tone: 'neutral' },
    ],
  });
});

test('warns of a silent video and of videos that are not in step', () => {
  const sources = [source('video:0', { state: 'silent' }), source('video:1'), source('video:2')];
  const spreadMs = { p50: 30, p95: 60.2, p99: 70, max: 80 } as VideoStats['spreadMs'];
  const report = videoReport(stats({ sources, spreadMs }), ['Front']);
  expect(report).toMatchObject({ summary: 'In step within 60 ms', tone: 'warning' });
  expect(report.lines[0]).toEqual({ name: 'Front', text: 'silent', tone: 'warning' });
  expect(videoReport(stats({ sources: sources.slice(0, 1) }), []).summary).toBe('No video comes');
  expect(videoReport(stats({ sources: sources.slice(0, 2) }), []).summary).toBe('One video');
});

test('synchronisation that is off, one video only, and frames that could not be used', () => {
  expect(videoReport(stats({ synchronised: false }), []).lines[0]?.text).toBe('as it comes');
  expect(videoReport(stats({ synchronised: false }), []).summary).toBe('Not in step');
  expect(videoReport(stats({ spreadMs: null }), []).summary).toBe('One video');
  const { lines } = videoReport(
    stats({ sources: [], undecoded: { 'waits-for-key': 4, x: 0 }, undated: 2 }),
    [],
  );
  expect(lines.map(({ name, text }) => `${name}: ${text}`)).toEqual([
    'Not decoded: 4 waits for key',
    'Without a time: 2',
  ]);
});
