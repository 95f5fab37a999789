import { request as plainRequest } from 'node:http';
import { request as secureRequest } from 'node:https';
import * as z from 'zod/mini';

/** A longer answer is not read, bytes. Chosen: the answer says no more than how many spans were refused, and why. */
const MOST_ANSWER_BYTES = 16_384;
/** Answers after which the same spans may be sent again: opentelemetry.io/docs/specs/otlp, "Retryable Response Codes". */
const RETRYABLE: ReadonlySet<number | undefined> = new Set([429, 502, 503, 504]);

/** What became of a batch. */
export type PostOutcome =
  | { kind: 'taken'; refusedSpans: number }
  /** It may be sent again. */
  | { kind: 'failed'; detail: string }
  /** It will never be taken. */
  | { kind: 'refused'; detail: string };

/** `partialSuccess` of an `ExportTraceServiceResponse`. */
const answerSchema = z.object({
  partialSuccess: z.optional(
    z.object({
      rejectedSpans: z.optional(
        z.union([z.int().check(z.minimum(0)), z.string().check(z.regex(/^\d{1,9}$/))]),
      ),
    }),
  ),
});

interface PostOptions {
  /** Authorities besides the system's own, PEM. */
  ca: string | undefined;
  /** How long an answer may take. */
  timeoutMs: number;
  /** Ends it early. */
  signal: AbortSignal;
}

/** Posts one batch, compressed by gzip. Follows no redirects. Never throws. */
export function postSpans(
  url: URL,
  body: Buffer,
  { ca, timeoutMs, signal }: PostOptions,
): Promise<PostOutcome> {
  const within = AbortSignal.any([signal, AbortSignal.timeout(timeoutMs)]);
  const headers = {
    'content-type': 'application/json',
    'content-encoding': 'gzip',
    'content-length': body.length,
  };
  const options = { method: 'POST', headers, signal: within, ...(ca === undefined ? {} : { ca }) };
  return new Promise((resolve) => {
    const fail = (error: Error) => {
      const detail = within.aborted && !signal.aborted ? `no answer within ${timeoutMs} ms` : error.message;
      resolve({ kind: 'failed', detail });
    };
    const request = (url.protocol === 'https:' ? secureRequest : plainRequest)(url, options, (response) => {
      const chunks: Buffer[] = [];
      let bytes = 0;
      response.on('data', (chunk: Buffer) => {
        bytes += chunk.length;
        if (bytes > MOST_ANSWER_BYTES) request.destroy(new Error('the answer is too long'));
        else chunks.push(chunk);
      });
      response.on('error', fail);
      response.on('end', () => resolve(outcomeOf(response.statusCode, Buffer.concat(chunks).toString())));
    });
    request.on('error', fail);
    request.end(body);
  });
}

function outcomeOf(status: number | undefined, text: string): PostOutcome {
  if (RETRYABLE.has(status)) return { kind: 'failed', detail: `status ${status}` };
  if (status === undefined || status < 200 || status > 299)
    return { kind: 'refused', detail: `status ${status}` };
  try {
    const { partialSuccess } = z.parse(answerSchema, text === '' ? {} : JSON.parse(text));
    return { kind: 'taken', refusedSpans: Number(partialSuccess?.rejectedSpans ?? 0) };
  } catch {
    return { kind: 'refused', detail: `status ${status}, but the answer is not OTLP’s` };
  }
}
