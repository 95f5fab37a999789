import { type MessagePort, Worker } from 'node:worker_threads';
import type {
  CameraDescription,
  PlayedMessage,
  PlayedPicture,
  SourceDescription,
  TimedBaseState,
} from '@farpoint/cloud-source';
import type { CloudKind } from '@farpoint/recording';
import type { TopicReading } from '@farpoint/ros';
import type { CaptureBudget } from '../encode/capture-budget.ts';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import type { CaptureOptions, CaptureReport, CaptureRequest, ReadyFrame } from './capture-messages.ts';

/** The capture thread ended unexpectedly. */
export class CaptureError extends Error {
  override readonly name = 'CaptureError';
  /** The sensor's index on this robot. */
  readonly sensor: number;

  constructor(sensor: number, message: string, options?: ErrorOptions) {
    super(message, options);
    this.sensor = sensor;
  }
}

type Introduction = Extract<CaptureReport, { type: 'ready' }>;

/** Records the clouds of a capture thread. */
export interface CaptureRecording {
  /** Port of a `SessionRecorder`; it is transferred to the capture thread. */
  clouds: MessagePort;
  /** Highest number of clouds recorded per second, by kind; 0 records none. */
  perSecond: Readonly<Record<CloudKind, number>>;
  /** Highest number of clouds of each kind per second for live viewers. */
  livePerSecond: number;
}

/** The main thread's end of the capture worker. */
export class Capture {
  readonly description: SourceDescription;
  /** Cameras whose pictures are available. */
  readonly cameras: readonly CameraDescription[];
  /** Called with each frame. The callee must return the buffer with `recycle`. */
  onFrame: ((frame: ReadyFrame) => void) | null = null;
  /** Called with what receivers of coded frames need, before the first of these frames and at each change. */
  onStream: ((stream: CodedStream) => void) | null = null;
  onState: ((state: TimedBaseState) => void) | null = null;
  /** Called once if the thread ends unexpectedly. */
  onFailure: ((error: CaptureError) => void) | null = null;
  /** Called at each new fault of the source that may be temporary. */
  onFault: ((detail: string) => void) | null = null;
  /** Number of those faults. */
  faults = 0;
  /** Called with what a played recording tells about the robot. */
  onTelemetry: ((message: PlayedMessage) => void) | null = null;
  /** Called with the coded pictures of the played videos that are watched. */
  onVideo: ((video: number, picture: PlayedPicture) => void) | null = null;
  /** Elevations of the rings of its LiDAR, radians, ascending; `null` while they are not known. */
  rings: readonly number[] | null = null;
  /** Called when they are known, and when they change. */
  onRings: (() => void) | null = null;
  /** Frames not captured because no buffer was free. */
  framesWithoutBuffer = 0;
  readonly #sensor: number;
  readonly #worker: Worker;
  #closing = false;
  #onReading: ((reading: TopicReading) => void) | null = null;
  /** The newest reading of each topic, until somebody takes them: a map may come once only. */
  readonly #early = new Map<string, TopicReading>();

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
      } else if (report.type === 'rings') {
        this.rings = report.elevations;
        this.onRings?.();
      } else if (report.type === 'reading') {
        if (this.#onReading === null) this.#early.set(report.reading.topic, report.reading);
        else this.#onReading(report.reading);
      } else if (report.type === 'telemetry') {
        this.onTelemetry?.(report.message);
      } else if (report.type === 'video') {
        this.onVideo?.(report.video, report.picture);
      }
    });
    worker.on('error', (error) => this.#fail(errorText(error)));
    worker.on('exit', (code) => this.#fail(`exit code ${code}`));
  }

  /** @throws {CaptureError} if the source cannot be opened, with the reason */
  static async start(options: CaptureOptions, recording: CaptureRecording | null = null): Promise<Capture> {
    const { sensor } = options;
    const worker = new Worker(new URL('./capture-worker.ts', import.meta.url), {
      name: 'capture',
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

  /** Called with readings of the robot's topics, for people; at once with those that have come before. */
  set onReading(take: ((reading: TopicReading) => void) | null) {
    this.#onReading = take;
    if (take === null) return;
    for (const reading of this.#early.values()) take(reading);
    this.#early.clear();
  }

  setBudget(budget: CaptureBudget): void {
    this.#post({ type: 'budget', ...budget });
  }

  /** Sends the pictures of `cameras` to this port from now on. */
  usePictures(port: MessagePort): void {
    this.#post({ type: 'pictures', port }, [port]);
  }

  watchVideo(video: number, watched: boolean): void {
    this.#post({ type: 'watchVideo', video, watched });
  }

  /** Whether the obstacle guard needs clouds, even if nobody watches. */
  guard(wanted: boolean): void {
    this.#post({ type: 'guard', wanted });
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
