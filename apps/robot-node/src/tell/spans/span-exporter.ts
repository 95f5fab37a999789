/** Exports where the time of clouds and commands goes as spans, over OTLP/HTTP. */
import { randomBytes } from 'node:crypto';
import { promisify } from 'node:util';
import { gzip } from 'node:zlib';
import type { Logger } from '@farpoint/service';
import { Backoff } from '@farpoint/timing';
import { ReasonCounts } from '../../ground/robot-counters.ts';
import { unixOffsetMs } from '../../ground/wall-clock.ts';
import { encodeTraces, type SpanResource } from './otlp-json.ts';
import { postSpans } from './otlp-post.ts';
import { type Trace, TraceQueue } from './trace-queue.ts';

/**
 * Traces of a batch. Chosen: three times those of an interval, so that what waited in an outage catches up; to encode them takes
 * the main thread a millisecond.
 */
const MOST_TRACES = 60;
/** Time that the last batch has when the robot ends, ms. Chosen: an end that is asked for must not wait for a collector. */
const LAST_MS = 1000;

/** When it sends, all ms. */
interface ExportTimes {
  /** Between two batches. */
  everyMs: number;
  /** The longest wait for an answer. */
  timeoutMs: number;
  /** The first and the longest wait after a failure. */
  firstRetryMs: number;
  mostRetryMs: number;
}

/**
 * Chosen: batches soon enough for who looks, in one request for 20 traces; an answer within the time that OpenTelemetry's
 * exporters wait by default; a collector that restarts is found soon, and one that is gone costs little.
 */
const TIMES: ExportTimes = { everyMs: 2000, timeoutMs: 10_000, firstRetryMs: 2000, mostRetryMs: 60_000 };

export interface SpanOptions extends SpanResource {
  /** Where spans are posted. */
  url: string;
  /** Authorities besides the system's own, PEM. */
  ca?: string | undefined;
}

interface Batch {
  body: Buffer;
  spanCount: number;
}

const compress = promisify(gzip);

export class SpanExporter {
  readonly traces = new TraceQueue(Math.random);
  /** Spans since the start, by what became of them. */
  readonly outcomes = new ReasonCounts();
  readonly #options: SpanOptions;
  readonly #log: Logger;
  readonly #times: ExportTimes;
  readonly #backoff: Backoff;
  readonly #end = new AbortController();
  #timer: NodeJS.Timeout;
  /** What is being sent, or will be sent again. */
  #batch: Batch | null = null;
  #sending: Promise<void> = Promise.resolve();
  /** One line says that spans no longer arrive, and one that they do again. */
  #isFailing = false;

  constructor(options: SpanOptions, log: Logger, times = TIMES) {
    this.#options = options;
    this.#log = log;
    this.#times = times;
    const { firstRetryMs: firstMs, mostRetryMs: mostMs } = times;
    this.#backoff = new Backoff({ firstMs, mostMs, random: Math.random });
    this.#timer = this.#later(times.everyMs);
  }

  /** Sends what waits once more, and ends. */
  async close(): Promise<void> {
    clearTimeout(this.#timer);
    const ending = setTimeout(() => this.#end.abort(), LAST_MS);
    await this.#sending;
    clearTimeout(this.#timer);
    if (!this.#isFailing && !this.#end.signal.aborted) await this.#send();
    clearTimeout(ending);
    this.#end.abort();
    clearTimeout(this.#timer);
  }

  #later(inMs: number): NodeJS.Timeout {
    const timer = setTimeout(() => {
      this.#sending = this.#send();
    }, inMs);
    return timer.unref();
  }

  /** Never throws: the robot goes on without spans. */
  async #send(): Promise<void> {
    let waitMs = this.#times.everyMs;
    try {
      this.#batch ??= await this.#nextBatch();
      if (this.#batch !== null) waitMs = await this.#post(this.#batch);
    } catch (error) {
      this.#batch = null;
      waitMs = this.#failed(String(error));
    }
    if (!this.#end.signal.aborted) this.#timer = this.#later(waitMs);
  }

  async #nextBatch(): Promise<Batch | null> {
    const traces: Trace[] = this.traces.take(MOST_TRACES);
    if (traces.length === 0) return null;
    const rim = { unixOffsetMs: unixOffsetMs(), randomBytes };
    const { body, spanCount } = encodeTraces(traces, this.#options, rim);
    return { body: await compress(body), spanCount };
  }

  /** @returns after how long to go on, ms */
  async #post(batch: Batch): Promise<number> {
    const { url, ca } = this.#options;
    const { timeoutMs } = this.#times;
    const outcome = await postSpans(new URL(url), batch.body, { ca, timeoutMs, signal: this.#end.signal });
    if (outcome.kind === 'failed') return this.#failed(outcome.detail);
    this.#batch = null;
    if (outcome.kind === 'refused') {
      this.outcomes.add('refused', batch.spanCount);
      return this.#failed(outcome.detail);
    }
    const refused = Math.min(batch.spanCount, outcome.refusedSpans);
    this.outcomes.add('refused', refused);
    this.outcomes.add('sent', batch.spanCount - refused);
    if (this.#isFailing) this.#log.info('spans arrive again at the OTLP endpoint');
    this.#isFailing = false;
    this.#backoff.reset();
    return this.#times.everyMs;
  }

  #failed(detail: string): number {
    if (!this.#isFailing && !this.#end.signal.aborted)
      this.#log.warn(
        { detail },
        'spans do not arrive at the OTLP endpoint: the robot tries again, and goes on',
      );
    this.#isFailing = true;
    return this.#backoff.nextMs();
  }
}
