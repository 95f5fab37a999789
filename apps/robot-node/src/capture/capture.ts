import { type MessagePort, Worker } from 'node:worker_threads';
import type { CloudKind } from '@farpoint/recording';
import type { TopicReading } from '@farpoint/ros';
import type { TimedBaseState } from '../base/base.ts';
import type { CaptureBudget } from '../encode/capture-budget.ts';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import type { CaptureOptions, CaptureReport, CaptureRequest, ReadyFrame } from './capture-messages.ts';
import type { CameraDescription, SourceDescription } from './frame-source.ts';

/** The capture thread ended by itself. */
export class CaptureError extends Error {
  override readonly name = 'CaptureError';
  /** Whose: its number among the robot's sensors. */
  readonly sensor: number;

  constructor(sensor: number, message: string, options?: ErrorOptions) {
    super(message, options);
    this.sensor = sensor;
  }
}

type Introduction = Extract<CaptureReport, { type: 'ready' }>;

/** Where clouds are recorded. */
export interface CaptureRecording {
  /** Of a `SessionRecorder`; it goes to the capture thread. */
  clouds: MessagePort;
  /** Clouds recorded a second at most; 0 records none. */
  perSecond: Readonly<Record<CloudKind, number>>;
}

/** The main thread's end of the capture worker. */
export class Capture {
  readonly description: SourceDescription;
  /** Cameras whose pictures can be had. */
  readonly cameras: readonly CameraDescription[];
  /** Gets each frame; it must give the buffer back with `recycle`. */
  onFrame: ((frame: ReadyFrame) => void) | null = null;
  /** Gets what receivers of coded frames need, before the first of them and at each change. */
  onStream: ((stream: CodedStream) => void) | null = null;
  onState: ((state: TimedBaseState) => void) | null = null;
  /** Called once, if the thread ends without having been asked to. */
  onFailure: ((error: CaptureError) => void) | null = null;
  /** Called at each new thing that is wrong with the source and may pass. */
  onFault: ((detail: string) => void) | null = null;
  /** How often that was. */
  faults = 0;
  /** Gets what the robot's topics say, for people. */
  onReading: ((reading: TopicReading) => void) | null = null;
  /** Frames not captured because all buffers were out. */
  framesWithoutBuffer = 0;
  readonly #sensor: number;
  readonly #worker: Worker;
  #closing = false;

  private constructor(sensor: number, worker: Worker, { description, cameras }: Introduction) {
    this.#sensor = sensor;
    this.#worker = worker;
    this.description = description;
    this.cameras = cameras;
    worker.on('message', (report: CaptureReport) => {
      if (report.type === 'frame') {
        if (this.onFrame === null) this.recycle(report.buffer);
        else this.onFrame(report);
      } else if (report.type === 'stream') {
        this.onStream?.(report.stream);
      } else if (report.type === 'state') {
        this.framesWithoutBuffer = report.framesWithoutBuffer;
        this.onState?.(report.state);
      } else if (report.type === 'fault') {
        this.faults++;
        this.onFault?.(report.detail);
      } else if (report.type === 'reading') {
        this.onReading?.(report.reading);
      }
    });
    worker.on('error', (error) => this.#fail(errorText(error)));
    worker.on('exit', (code) => this.#fail(`exit code ${code}`));
  }

  /** @throws {CaptureError} where the source cannot be opened, saying why */
  static async start(options: CaptureOptions, recording: CaptureRecording | null = null): Promise<Capture> {
    const { sensor } = options;
    const worker = new Worker(new URL('./capture-worker.ts', import.meta.url), {
      workerData: { ...options, recording },
      transferList: recording === null ? [] : [recording.clouds],
    });
    const introduction = await new Promise<Introduction>((resolve, reject) => {
      const onError = (error: unknown) =>
        reject(new CaptureError(sensor, errorText(error), { cause: error }));
      const onExit = (code: number) => onError(new Error(`the capture thread ended with code ${code}`));
      worker.once('error', onError);
      worker.once('exit', onExit);
      worker.once('message', (report: CaptureReport) => {
        worker.off('error', onError);
        worker.off('exit', onExit);
        if (report.type === 'ready') resolve(report);
        else reject(new CaptureError(sensor, 'the capture thread did not introduce itself'));
      });
    });
    return new Capture(sensor, worker, introduction);
  }

  setBudget(budget: CaptureBudget): void {
    this.#post({ type: 'budget', ...budget });
  }

  /** Pictures of `cameras` go to this port from now on. */
  usePictures(port: MessagePort): void {
    this.#post({ type: 'pictures', port }, [port]);
  }

  requestLatencyTest(): void {
    this.#post({ type: 'latencyTest' });
  }

  recycle(buffer: ArrayBuffer): void {
    this.#post({ type: 'recycle', buffer }, [buffer]);
  }

  async close(): Promise<void> {
    if (this.#closing) return;
    this.#closing = true;
    const ended = new Promise((resolve) => this.#worker.once('exit', resolve));
    this.#post({ type: 'close' });
    await ended;
  }

  #post(request: CaptureRequest, transfer: (ArrayBuffer | MessagePort)[] = []): void {
    this.#worker.postMessage(request, transfer);
  }

  #fail(detail: string): void {
    if (this.#closing) return;
    this.#closing = true;
    this.onFailure?.(new CaptureError(this.#sensor, `the capture thread ended: ${detail}`));
  }
}

function errorText(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
