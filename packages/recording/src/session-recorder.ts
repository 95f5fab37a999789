import { MessageChannel, type MessagePort, Worker } from 'node:worker_threads';
import type { PictureFormat, Pose, Twist } from '@farpoint/protocol';
import { CreditQueue } from './credit-queue.ts';
import { RecordingError } from './errors.ts';
import type {
  DropKind,
  EventRecord,
  JsonKind,
  PictureRecord,
  RecordedCamera,
  RecorderOptions,
  RecorderReport,
  RecorderRequest,
} from './recorder-messages.ts';

/** How many events the writer may hold, and how many may wait for it. */
const LIMITS = { underWay: 256, waiting: 4096 };
/** The same for pictures: 16 MB of the largest that are sent. */
const PICTURE_LIMITS = { underWay: 4, waiting: 24 };

/** The main thread's end of a recording. The capture thread has its own, {@link clouds}. */
export class SessionRecorder {
  /** For the capture thread, which makes a `CloudTap` of it. */
  readonly clouds: MessagePort;
  /** Called once when the file reaches its maximum size: it is then closed and complete. */
  onFull: (() => void) | null = null;
  /** Called once if nothing more can be written. The robot continues. */
  onFailure: ((error: RecordingError) => void) | null = null;
  /** Messages so far. */
  messages = 0;
  bytes = 0;
  /** Clouds and pictures that could not be converted to messages. */
  faults = 0;
  #cloudsDropped = { captured: 0, sent: 0 };
  readonly #worker: Worker;
  readonly #path: string;
  readonly #events: CreditQueue<EventRecord>;
  readonly #pictures: CreditQueue<Omit<PictureRecord, 'dropped'>>;
  readonly #sequences = new Map<string, number>();
  #closing = false;
  #failed = false;
  #full = false;

  private constructor(worker: Worker, clouds: MessagePort, path: string) {
    this.#worker = worker;
    this.#path = path;
    this.clouds = clouds;
    this.#events = new CreditQueue(LIMITS, (event) => this.#post(event));
    this.#pictures = new CreditQueue(PICTURE_LIMITS, (picture) => this.#postPicture(picture));
    worker.on('message', (report: RecorderReport) => {
      if (report.type === 'done') (report.kind === 'pictures' ? this.#pictures : this.#events).done();
      else if (report.type === 'written') {
        this.messages = report.messages;
        this.bytes = report.bytes;
        this.faults = report.faults;
        this.#cloudsDropped = report.dropped;
      } else if (report.type === 'full') {
        this.#full = true;
        this.onFull?.();
      } else if (report.type === 'failed') this.#fail(report.detail);
    });
    worker.on('error', (error) => this.#fail(error instanceof Error ? error.message : String(error)));
  }

  /** @throws {RecordingError} if the file already exists or cannot be created */
  static async open(options: RecorderOptions): Promise<SessionRecorder> {
    const { port1, port2 } = new MessageChannel();
    const worker = new Worker(new URL('./recorder-worker.ts', import.meta.url), {
      workerData: { ...options, clouds: port2 },
      transferList: [port2],
    });
    await new Promise<void>((resolve, reject) => {
      worker.once('error', (error) =>
        reject(
          new RecordingError('unreadable', error instanceof Error ? error.message : String(error), {
            file: options.path,
            cause: error,
          }),
        ),
      );
      worker.once('message', () => resolve());
    });
    worker.removeAllListeners('error');
    return new SessionRecorder(worker, port1, options.path);
  }

  /** What was not recorded because the writer did not keep up. */
  get dropped(): Readonly<Record<DropKind, number>> {
    return {
      ...this.#cloudsDropped,
      pictures: this.#pictures.dropped,
      events: this.#events.dropped,
    };
  }

  /** The cameras whose pictures are recorded: call once, before the first picture. */
  cameras(cameras: readonly RecordedCamera[]): void {
    this.#post({ type: 'cameras', cameras: cameras.map(({ name, ofCloud }) => ({ name, ofCloud })) });
  }

  /** A picture as it is sent to operators. @param file its memory belongs to the recorder from now on */
  picture(camera: number, capturedAtMs: number, format: PictureFormat, file: Uint8Array<ArrayBuffer>): void {
    if (!this.#writing) return;
    const sequence = this.#next(`picture ${camera}`);
    this.#pictures.push({ type: 'picture', camera, capturedAtMs, sequence, format, file });
  }

  json(kind: JsonKind, timeMs: number, value: object): void {
    this.#push({ type: 'json', kind, timeMs, value, sequence: this.#next(kind) });
  }

  /** Records the velocity that the wheels were given. */
  velocity(timeMs: number, twist: Twist): void {
    this.#push({ type: 'velocity', timeMs, twist, sequence: this.#next('velocity') });
  }

  /** Records the robot's pose and velocity. */
  state(timeMs: number, pose: Pose, twist: Twist): void {
    this.#push({ type: 'state', timeMs, pose, twist, sequence: this.#next('state') });
  }

  /** Writes what waits, and the index. Close the capture thread first. */
  async close(): Promise<void> {
    if (this.#closing) return;
    this.#closing = true;
    this.#events.drain();
    this.#pictures.drain();
    const ended = new Promise((resolve) => this.#worker.once('exit', resolve));
    this.#post({ type: 'close' });
    await ended;
  }

  #push(event: EventRecord): void {
    if (this.#writing) this.#events.push(event);
  }

  get #writing(): boolean {
    return !this.#closing && !this.#failed && !this.#full;
  }

  #post(request: RecorderRequest): void {
    this.#worker.postMessage(request);
  }

  #postPicture(picture: Omit<PictureRecord, 'dropped'>): void {
    const record: PictureRecord = { ...picture, dropped: this.#pictures.dropped };
    this.#worker.postMessage(record, [picture.file.buffer]);
  }

  #next(kind: string): number {
    const sequence = this.#sequences.get(kind) ?? 0;
    this.#sequences.set(kind, sequence + 1);
    return sequence;
  }

  #fail(detail: string): void {
    if (this.#failed) return;
    this.#failed = true;
    this.onFailure?.(new RecordingError('unreadable', `recording stopped: ${detail}`, { file: this.#path }));
  }
}
