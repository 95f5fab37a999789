import { Worker } from 'node:worker_threads';
import { RobotStopSignal, type RobotStopState } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { Backoff } from '@farpoint/timing';
import type { GraphOptions } from '../ros/open-graph.ts';
import { StopCells, type StopHeard } from './stop-cells.ts';
import { STEADY_MS, type StopSource } from './stop-source.ts';
import type { TopicStopReport, TopicStopSetup } from './topic-stop-worker.ts';

const THREAD = new URL('./topic-stop-worker.ts', import.meta.url);
const FIRST_RETRY_MS = 250;
const MOST_RETRY_MS = 10_000;
/** The time that the thread has to leave the graph, ms. */
const CLOSE_MS = 1000;

export interface TopicStopOptions {
  graph: GraphOptions;
  topic: string;
  /** A topic that is silent for longer stops, ms. */
  silentMs: number;
}

/** A std_msgs/Bool topic of the robot's ROS graph: true stops, and so do silence and a publisher that is gone. */
export class TopicStop implements StopSource {
  readonly stop = 'topic';
  readonly name: string;
  onChange: (() => void) | null = null;
  readonly #options: TopicStopOptions;
  readonly #log: Pick<Logger, 'warn' | 'error'>;
  readonly #signal: RobotStopSignal;
  readonly #backoff = new Backoff({ firstMs: FIRST_RETRY_MS, mostMs: MOST_RETRY_MS, random: Math.random });
  #cells = new StopCells();
  #last: StopHeard | null = null;
  #worker: Worker | null = null;
  #ended: Promise<unknown> = Promise.resolve();
  #retry: NodeJS.Timeout | null = null;
  #fault: string | null = null;
  #closing = false;

  constructor(options: TopicStopOptions, log: Pick<Logger, 'warn' | 'error'>) {
    this.#options = options;
    this.#log = log;
    this.name = `topic ${options.topic}`;
    this.#signal = new RobotStopSignal({ silentMs: options.silentMs, steadyMs: STEADY_MS });
    this.#start();
  }

  get fault(): string | null {
    return this.#fault;
  }

  look(nowMs: number): RobotStopState {
    const heard = this.#cells.read(nowMs);
    if (heard !== null) {
      // A stop that a go has followed since the last look counts as well.
      if (heard.stops !== (this.#last?.stops ?? 0)) this.#signal.hear(true, heard.atMs);
      if (heard.atMs !== this.#last?.atMs) this.#signal.hear(heard.stop, heard.atMs);
      if (heard.publishers === 0) this.#signal.lose();
      this.#last = heard;
    }
    return this.#signal.state(nowMs);
  }

  async close(): Promise<void> {
    this.#closing = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    const worker = this.#worker;
    worker?.postMessage('close');
    const late = setTimeout(() => void worker?.terminate(), CLOSE_MS);
    await this.#ended;
    clearTimeout(late);
  }

  #start(): void {
    const { graph, topic } = this.#options;
    this.#cells = new StopCells();
    this.#last = null;
    const workerData: TopicStopSetup = { graph, topic, cells: this.#cells.memory };
    const worker = new Worker(THREAD, { name: 'stop topic', workerData });
    this.#worker = worker;
    worker.on('message', (report: TopicStopReport) => this.#onReport(report));
    worker.on('error', (error: unknown) =>
      this.#lose(error instanceof Error ? error.message : String(error)),
    );
    this.#ended = new Promise((resolve) => worker.once('exit', resolve));
    worker.once('exit', () => this.#onExit());
  }

  #onReport(report: TopicStopReport): void {
    if (report.type === 'changed') {
      this.#fault = null;
      this.#backoff.reset();
    } else if (report.type === 'failed') this.#lose(report.detail);
    else {
      this.#fault = report.detail;
      this.#log.warn({ detail: report.detail }, 'the graph of the stop topic has a fault');
    }
    this.onChange?.();
  }

  #lose(detail: string): void {
    this.#fault = detail;
    this.#signal.lose();
    this.#log.error({ detail }, 'the stop topic cannot be heard');
    this.onChange?.();
  }

  #onExit(): void {
    this.#worker = null;
    if (this.#closing) return;
    this.#signal.lose();
    this.onChange?.();
    this.#retry = setTimeout(() => this.#start(), this.#backoff.nextMs());
  }
}
