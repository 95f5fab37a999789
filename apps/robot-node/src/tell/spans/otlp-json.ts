/**
 * Traces as OpenTelemetry's `ExportTraceServiceRequest` in OTLP's JSON encoding (opentelemetry-proto 1.x, trace.proto;
 * opentelemetry.io/docs/specs/otlp, "JSON Protobuf Encoding"): ids are lower-case hex, 64-bit integers are decimal text,
 * enumerations are numbers.
 */
import type { CloudTrace, CommandTrace, Trace } from './trace-queue.ts';

const SERVICE = 'farpoint-robot';
/** SPAN_KIND_INTERNAL: what happens within the robot. */
const INTERNAL = 1;
/** STATUS_CODE_ERROR. */
const ERROR = 2;
/** Sizes of ids, bytes: trace.proto. */
const [TRACE_ID_BYTES, SPAN_ID_BYTES] = [16, 8];

/** What all spans have in common. */
export interface SpanResource {
  robotId: string;
  version: string;
}

/** What the encoding takes from outside. */
export interface SpanRim {
  /** What must be added to instants of the robot's clock to get Unix time, ms. */
  unixOffsetMs: number;
  /** So many random bytes, of which not all are zero. */
  randomBytes(count: number): Buffer;
}

interface Attribute {
  key: string;
  value: { intValue: string } | { boolValue: boolean } | { stringValue: string };
}

interface Span {
  traceId: string;
  spanId: string;
  parentSpanId?: string;
  name: string;
  kind: typeof INTERNAL;
  startTimeUnixNano: string;
  endTimeUnixNano: string;
  attributes?: Attribute[];
  events?: { timeUnixNano: string; name: string }[];
  status?: { code: typeof ERROR; message: string };
}

type Part = [name: string, fromMs: number, toMs: number];

/** @returns a body for a POST to `/v1/traces`, and how many spans it has */
export function encodeTraces(
  traces: readonly Trace[],
  resource: SpanResource,
  rim: SpanRim,
): { body: string; spanCount: number } {
  const scope = { name: SERVICE, version: resource.version };
  const spans = traces.flatMap((trace) =>
    trace.kind === 'cloud' ? cloudSpans(trace, rim) : commandSpans(trace, rim),
  );
  const attributes = [
    text('service.name', SERVICE),
    text('service.instance.id', resource.robotId),
    text('service.version', resource.version),
  ];
  const request = { resourceSpans: [{ resource: { attributes }, scopeSpans: [{ scope, spans }] }] };
  return { body: JSON.stringify(request), spanCount: spans.length };
}

function cloudSpans(trace: CloudTrace, rim: SpanRim): Span[] {
  const { capturedAtMs, inMemoryMs, readyMs, firstLeftMs, lastLeftMs } = trace;
  const spans = family(['cloud', capturedAtMs, lastLeftMs], rim, [
    ['capture', capturedAtMs, inMemoryMs],
    ['guard-and-encode', inMemoryMs, readyMs],
    ['queue', readyMs, lastLeftMs],
  ]);
  const [root, , , queue] = spans as [Span, Span, Span, Span];
  root.attributes = [
    count('farpoint.operator', trace.operator),
    count('farpoint.sensor', trace.sensor),
    count('farpoint.frame', trace.frame),
    count('farpoint.points', trace.points),
  ];
  queue.events = [{ timeUnixNano: nanos(firstLeftMs, rim), name: 'first-packet' }];
  return spans;
}

function commandSpans(trace: CommandTrace, rim: SpanRim): Span[] {
  const { receivedMs, judgedMs, wheelsMs } = trace;
  const gate: Part = ['gate', receivedMs, judgedMs];
  const parts: Part[] = wheelsMs === null ? [gate] : [gate, ['wheels', judgedMs, wheelsMs]];
  const spans = family(['command', receivedMs, wheelsMs ?? judgedMs], rim, parts);
  const [root] = spans as [Span];
  root.attributes = [
    count('farpoint.operator', trace.operator),
    count('farpoint.sequence', trace.sequence),
    { key: 'farpoint.refused', value: { boolValue: wheelsMs === null } },
  ];
  if (wheelsMs === null) root.status = { code: ERROR, message: 'the drive guard refused it' };
  return spans;
}

/** A span and its children, in one trace of their own. */
function family(root: Part, rim: SpanRim, children: readonly Part[]): Span[] {
  const traceId = rim.randomBytes(TRACE_ID_BYTES).toString('hex');
  const parentSpanId = rim.randomBytes(SPAN_ID_BYTES).toString('hex');
  return [
    span(root, { traceId, spanId: parentSpanId }, rim),
    ...children.map((child) =>
      span(child, { traceId, spanId: rim.randomBytes(SPAN_ID_BYTES).toString('hex'), parentSpanId }, rim),
    ),
  ];
}

function span(
  [name, fromMs, toMs]: Part,
  ids: Pick<Span, 'traceId' | 'spanId' | 'parentSpanId'>,
  rim: SpanRim,
): Span {
  const [startTimeUnixNano, endTimeUnixNano] = [nanos(fromMs, rim), nanos(toMs, rim)];
  return { ...ids, name, kind: INTERNAL, startTimeUnixNano, endTimeUnixNano };
}

/** Whole microseconds: a number of nanoseconds since 1970 has more digits than a double. */
function nanos(atMs: number, { unixOffsetMs }: SpanRim): string {
  return `${Math.round((atMs + unixOffsetMs) * 1000)}000`;
}

function count(key: string, value: number): Attribute {
  return { key, value: { intValue: String(value) } };
}

function text(key: string, value: string): Attribute {
  return { key, value: { stringValue: value } };
}
