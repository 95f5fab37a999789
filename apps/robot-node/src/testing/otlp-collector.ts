/** Stands in for an OpenTelemetry collector: takes OTLP/HTTP as JSON, and refuses whatever deviates from the mapping. */
import { createServer, type IncomingMessage, type Server, type ServerResponse } from 'node:http';
import type { AddressInfo } from 'node:net';
import { gunzipSync } from 'node:zlib';
import * as z from 'zod';

/** Unix time of 2020 and 2100, ns: what lies outside was not converted. */
const [EARLIEST_NS, LATEST_NS] = [1_577_836_800_000_000_000n, 4_102_444_800_000_000_000n];

const hex = (digits: number) => z.string().regex(new RegExp(`^(?!0+$)[0-9a-f]{${digits}}$`));
const nanos = z
  .string()
  .regex(/^\d{19}$/)
  .refine((text) => BigInt(text) > EARLIEST_NS && BigInt(text) < LATEST_NS);
const attributes = z.array(
  z.strictObject({
    key: z.string().min(1),
    value: z.union([
      z.strictObject({ stringValue: z.string() }),
      z.strictObject({ boolValue: z.boolean() }),
      z.strictObject({ intValue: z.string().regex(/^-?\d{1,19}$/) }),
    ]),
  }),
);
const span = z
  .strictObject({
    traceId: hex(32),
    spanId: hex(16),
    parentSpanId: hex(16).optional(),
    name: z.string().min(1),
    kind: z.literal([1, 2, 3, 4, 5]),
    startTimeUnixNano: nanos,
    endTimeUnixNano: nanos,
    attributes: attributes.optional(),
    events: z.array(z.strictObject({ timeUnixNano: nanos, name: z.string().min(1) })).optional(),
    status: z.strictObject({ code: z.literal([0, 1, 2]), message: z.string() }).optional(),
  })
  .refine(({ startTimeUnixNano, endTimeUnixNano }) => BigInt(startTimeUnixNano) <= BigInt(endTimeUnixNano));
const scopeSpans = z.strictObject({
  scope: z.strictObject({ name: z.string().min(1), version: z.string().min(1) }),
  spans: z.array(span).min(1),
});
const traceRequest = z.strictObject({
  resourceSpans: z.array(
    z.strictObject({ resource: z.strictObject({ attributes }), scopeSpans: z.array(scopeSpans) }),
  ),
});

export type CollectedSpan = z.infer<typeof span>;

/** The spans of a request. @throws {z.ZodError} if it is not as OTLP says */
export function spansOf(body: string): CollectedSpan[] {
  const { resourceSpans } = traceRequest.parse(JSON.parse(body));
  return resourceSpans.flatMap((each) => each.scopeSpans.flatMap(({ spans }) => spans));
}

/** Those who sent a request. */
function sendersOf(body: string): unknown[] {
  const { resourceSpans } = traceRequest.parse(JSON.parse(body));
  return resourceSpans.map(({ resource }) => attributesOf(resource)['service.instance.id']);
}

/** A span's attributes, integers as numbers. */
export function attributesOf({
  attributes: given = [],
}: Pick<CollectedSpan, 'attributes'>): Record<string, unknown> {
  return Object.fromEntries(
    given.map(({ key, value }) => [
      key,
      'intValue' in value ? Number(value.intValue) : Object.values(value)[0],
    ]),
  );
}

export class OtlpCollector {
  readonly spans: CollectedSpan[] = [];
  /** The robots whose spans these are. */
  readonly senders = new Set<unknown>();
  /** What was wrong with requests. */
  readonly faults: string[] = [];
  /** Requests that came, whatever became of them. */
  requests = 0;
  /** What it does instead of taking spans: answers with a status or a text, or not at all. */
  answer: { status: number; text: string } | 'nothing' | null = null;
  readonly #server: Server;

  private constructor() {
    this.#server = createServer((request, response) => void this.#take(request, response));
  }

  /** @param port 0: any free one */
  static async listen(port = 0): Promise<OtlpCollector> {
    const collector = new OtlpCollector();
    await new Promise<void>((resolve) => collector.#server.listen(port, '127.0.0.1', resolve));
    return collector;
  }

  get url(): string {
    return `http://127.0.0.1:${(this.#server.address() as AddressInfo).port}`;
  }

  async close(): Promise<void> {
    this.#server.closeAllConnections();
    await new Promise((resolve) => this.#server.close(resolve));
  }

  async #take(request: IncomingMessage, response: ServerResponse): Promise<void> {
    const chunks: Buffer[] = [];
    for await (const chunk of request) chunks.push(chunk as Buffer);
    this.requests++;
    if (this.answer === 'nothing') return;
    if (this.answer !== null) {
      response.writeHead(this.answer.status).end(this.answer.text);
      return;
    }
    try {
      const { method, url, headers } = request;
      const told = `${method} ${url} ${headers['content-type']} ${headers['content-encoding']}`;
      if (told !== 'POST /v1/traces application/json gzip') throw new Error(told);
      const body = gunzipSync(Buffer.concat(chunks)).toString();
      this.spans.push(...spansOf(body));
      for (const sender of sendersOf(body)) this.senders.add(sender);
      response.writeHead(200, { 'content-type': 'application/json' }).end('{"partialSuccess":{}}');
    } catch (error) {
      this.faults.push(String(error));
      response.writeHead(400).end();
    }
  }
}
