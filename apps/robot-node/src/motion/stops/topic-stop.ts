import { RobotStopSignal, type RobotStopState } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import { KeptThread } from '../../ground/threads/kept-thread.ts';
import { StopCells, type StopHeard } from './stop-cells.ts';
import { STEADY_MS, type StopSource } from './stop-source.ts';
import type { TopicStopReport, TopicStopSetup } from './topic-stop-worker.ts';

const PROGRAM = new URL('./topic-stop-worker.ts', import.meta.url);

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
  readonly #thread: KeptThread<TopicStopReport>;
  #cells = new StopCells();
  #last: StopHeard | null = null;
  #fault: string | null = null;

  constructor(options: TopicStopOptions, log: Pick<Logger, 'warn' | 'error'>) {
    this.#options = options;
    this.#log = log;
    this.name = `topic ${options.topic}`;
    this.#signal = new RobotStopSignal({ silentMs: options.silentMs, steadyMs: STEADY_MS });
    this.#thread = new KeptThread<TopicStopReport>({
      program: PROGRAM,
      name: 'stop topic',
      closeMessage: 'close',
      data: () => this.#setup(),
      onReport: (report) => this.#onReport(report),
      onError: (detail) => this.#lose(detail),
      onEnd: () => this.#onEnd(),
    });
    this.#thread.start();
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

  close(): Promise<void> {
    return this.#thread.close();
  }

  #setup(): TopicStopSetup {
    const { graph, topic } = this.#options;
    this.#cells = new StopCells();
    this.#last = null;
    return { graph, topic, cells: this.#cells.memory };
  }

  #onReport(report: TopicStopReport): void {
    if (report.type === 'changed') {
      this.#fault = null;
      this.#thread.isWell();
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

  #onEnd(): void {
    this.#signal.lose();
    this.onChange?.();
  }
}
