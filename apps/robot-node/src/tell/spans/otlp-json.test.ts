import { expect, test } from 'vitest';
import { attributesOf, spansOf } from '../../testing/otlp-collector.ts';
import { encodeTraces } from './otlp-json.ts';
import type { CloudTrace, CommandTrace } from './trace-queue.ts';

/** 2026-11-30T00:00:00Z, ms, and what must be added to the robot's clock to get Unix time. */
const UNIX_OFFSET_MS = 1_796_000_000_000.25;
const RESOURCE = { robotId: 'r1', version: '1.2.3' };

const CLOUD: CloudTrace = {
  kind: 'cloud',
  operator: 2,
  sensor: 1,
  frame: 4_294_967_295,
  points: 12_000,
  capturedAtMs: 1000,
  inMemoryMs: 1005.001,
  readyMs: 1012,
  firstLeftMs: 1013,
  lastLeftMs: 1020,
};
const COMMAND: CommandTrace = {
  kind: 'command',
  operator: 1,
  sequence: 9,
  receivedMs: 2000,
  judgedMs: 2000.5,
  wheelsMs: 2001,
};

function rim() {
  let drawn = 0;
  return {
    unixOffsetMs: UNIX_OFFSET_MS,
    randomBytes: (bytes: number) => Buffer.alloc(bytes, 0xa0 + ++drawn),
  };
}

/** Name, and from when to when in µs since its trace's begin. */
function timesOf(body: string): [name: string, fromUs: number, toUs: number][] {
  const spans = spansOf(body);
  const begin = BigInt(spans[0]?.startTimeUnixNano ?? 0);
  const since = (nanos: string) => Number(BigInt(nanos) - begin) / 1000;
  return spans.map((span) => [span.name, since(span.startTimeUnixNano), since(span.endTimeUnixNano)]);
}

test('a cloud is a span with its stages as children, in a trace of its own', () => {
  const { body, spanCount } = encodeTraces([CLOUD], RESOURCE, rim());
  expect(spanCount).toBe(4);
  expect(timesOf(body)).toEqual([
    ['cloud', 0, 20_000],
    ['capture', 0, 5001],
    ['guard-and-encode', 5001, 12_000],
    ['queue', 12_000, 20_000],
  ]);
  const [root, ...children] = spansOf(body);
  expect(root?.parentSpanId).toBe(undefined);
  expect(new Set(children.map(({ parentSpanId }) => parentSpanId))).toEqual(new Set([root?.spanId]));
  expect(new Set(children.map(({ traceId }) => traceId))).toEqual(new Set([root?.traceId]));
  expect(new Set(children.map(({ spanId }) => spanId)).size).toBe(3);
  expect(attributesOf(root!)).toEqual({
    'farpoint.operator': 2,
    'farpoint.sensor': 1,
    'farpoint.frame': 4_294_967_295,
    'farpoint.points': 12_000,
  });
  expect(children[2]?.events).toEqual([{ name: 'first-packet', timeUnixNano: '1796000001013250000' }]);
});

test('a command is a span with the gate and the wheels; a refused one is an error without wheels', () => {
  const traces = [COMMAND, { ...COMMAND, wheelsMs: null }];
  const { body, spanCount } = encodeTraces(traces, RESOURCE, rim());
  expect(spanCount).toBe(5);
  expect(timesOf(body)).toEqual([
    ['command', 0, 1000],
    ['gate', 0, 500],
    ['wheels', 500, 1000],
    ['command', 0, 500],
    ['gate', 0, 500],
  ]);
  const [taken, , , refused] = spansOf(body);
  expect(taken?.status).toBe(undefined);
  expect(attributesOf(taken!)).toMatchObject({ 'farpoint.sequence': 9, 'farpoint.refused': false });
  expect(refused?.status?.code).toBe(2);
  expect(refused?.traceId).not.toBe(taken?.traceId);
});

test('ids are hex, times decimal text of nanoseconds, 64-bit integers text, kinds numbers', () => {
  const { body } = encodeTraces([COMMAND], RESOURCE, rim());
  expect(JSON.parse(body)).toEqual({
    resourceSpans: [
      {
        resource: {
          attributes: [
            { key: 'service.name', value: { stringValue: 'farpoint-robot' } },
            { key: 'service.instance.id', value: { stringValue: 'r1' } },
            { key: 'service.version', value: { stringValue: '1.2.3' } },
          ],
        },
        scopeSpans: [
          {
            scope: { name: 'farpoint-robot', version: '1.2.3' },
            spans: [
              {
                traceId: 'a1'.repeat(16),
                spanId: 'a2'.repeat(8),
                name: 'command',
                kind: 1,
                startTimeUnixNano: '1796000002000250000',
                endTimeUnixNano: '1796000002001250000',
                attributes: [
                  { key: 'farpoint.operator', value: { intValue: '1' } },
                  { key: 'farpoint.sequence', value: { intValue: '9' } },
                  { key: 'farpoint.refused', value: { boolValue: false } },
                ],
              },
              {
                traceId: 'a1'.repeat(16),
                spanId: 'a3'.repeat(8),
                parentSpanId: 'a2'.repeat(8),
                name: 'gate',
                kind: 1,
                startTimeUnixNano: '1796000002000250000',
                endTimeUnixNano: '1796000002000750000',
              },
              {
                traceId: 'a1'.repeat(16),
                spanId: 'a4'.repeat(8),
                parentSpanId: 'a2'.repeat(8),
                name: 'wheels',
                kind: 1,
                startTimeUnixNano: '1796000002000750000',
                endTimeUnixNano: '1796000002001250000',
              },
            ],
          },
        ],
      },
    ],
  });
});
