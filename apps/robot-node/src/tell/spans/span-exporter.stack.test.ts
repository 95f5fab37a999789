/** The exporter with a real HTTP server that takes, refuses, fails and hangs. */
import { silentLogger } from '@farpoint/service';
import { eventually } from '@farpoint/service/testing/eventually';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { OtlpCollector } from '../../testing/otlp-collector.ts';
import { SpanExporter } from './span-exporter.ts';

/** All ms: short but for the answer, which only a collector that hangs does not give. */
const TIMES = { everyMs: 20, timeoutMs: 60_000, firstRetryMs: 20, mostRetryMs: 80 };
const OPERATOR = {};

let collector: OtlpCollector;
let exporter: SpanExporter;
let start: (times?: Partial<typeof TIMES>) => void;
let lines: string[];

beforeEach(async () => {
  collector = await OtlpCollector.listen();
  lines = [];
  const line = vi.fn((_fields: unknown, text?: string) => void lines.push(String(text ?? _fields)));
  const log = { ...silentLogger(), warn: line, info: line } as unknown as ReturnType<typeof silentLogger>;
  const options = { url: `${collector.url}/v1/traces`, robotId: 'r1', version: '1.0.0' };
  start = (times) => {
    exporter = new SpanExporter(options, log, { ...TIMES, ...times });
  };
  start();
});

afterEach(async () => {
  await exporter.close();
  await collector.close();
});

let sequence = 0;
/** Each in a slot of its own. */
function command(): void {
  const atMs = ++sequence * 1000;
  exporter.traces.command(OPERATOR, sequence, atMs, atMs + 1, atMs + 2);
}
const sent = () => exporter.outcomes.get('sent');
const names = () => collector.spans.map(({ name }) => name);

test('sends spans that the collector takes, and nothing while there are none', async () => {
  command();
  await eventually(() => sent() === 3);
  expect(names()).toEqual(['command', 'gate', 'wheels']);
  expect(collector.faults).toEqual([]);
  expect(collector.requests).toBe(1);
  expect(lines).toEqual([]);
});

test('tries again after a 503, with the same spans, and says so once', async () => {
  collector.answer = { status: 503, text: 'busy' };
  command();
  await eventually(() => collector.requests >= 3);
  expect(lines).toEqual([expect.stringContaining('spans do not arrive')]);
  collector.answer = null;
  await eventually(() => sent() === 3);
  expect(names()).toEqual(['command', 'gate', 'wheels']);
  await eventually(() => lines.length === 2);
  expect(lines[1]).toContain('arrive again');
});

test('gives up an answer that does not come, and sends the same spans again', async () => {
  await exporter.close();
  start({ timeoutMs: 100 });
  collector.answer = 'nothing';
  command();
  await eventually(() => lines.length === 1);
  expect(sent()).toBe(0);
  collector.answer = null;
  await eventually(() => sent() === 3);
  expect(collector.faults).toEqual([]);
});

test('does not send again what was refused, and counts it', async () => {
  collector.answer = { status: 400, text: '' };
  command();
  await eventually(() => exporter.outcomes.get('refused') === 3);
  collector.answer = null;
  command();
  await eventually(() => sent() === 3);
  expect(collector.spans).toHaveLength(3);
});

test('counts the spans that a collector takes only in part', async () => {
  collector.answer = {
    status: 200,
    text: '{"partialSuccess":{"rejectedSpans":"2","errorMessage":"no room"}}',
  };
  command();
  await eventually(() => exporter.outcomes.get('refused') === 2);
  expect(sent()).toBe(1);
});

test.each(['<html></html>', `{"partialSuccess":{"rejectedSpans":-1}}`])(
  'refuses the answer %s of what is no collector',
  async (text) => {
    collector.answer = { status: 200, text };
    command();
    await eventually(() => exporter.outcomes.get('refused') === 3);
    expect(lines).toHaveLength(1);
  },
);

test('reads no answer without end', async () => {
  collector.answer = { status: 200, text: ' '.repeat(1_000_000) };
  command();
  await eventually(() => lines.length === 1);
  expect(sent()).toBe(0);
});

test('goes on without a collector, and finds it when it is back', async () => {
  const { port } = new URL(collector.url);
  await collector.close();
  command();
  await eventually(() => lines.length === 1);
  collector = await OtlpCollector.listen(Number(port));
  await eventually(() => sent() === 3);
});

test('sends what waits when it ends', async () => {
  command();
  await exporter.close();
  expect(names()).toEqual(['command', 'gate', 'wheels']);
});

test('ends although the collector hangs', async () => {
  collector.answer = 'nothing';
  command();
  await exporter.close();
  expect(sent()).toBe(0);
});
