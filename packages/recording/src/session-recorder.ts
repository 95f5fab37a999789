import { MessageChannel, type MessagePort, Worker } from 'node:worker_threads';
import type { DiagnosticReport, PictureFormat, Pose, Twist } from '@farpoint/protocol';
import { CreditQueue } from './credit-queue.ts';
import { RecordingError } from './errors.ts';
import { RecordedFile } from './recorded-file.ts';
import {
  type DropKind,
  type EventKind,
  type EventRecord,
  type JsonKind,
  type LiveReport,
  NO_LIVE_WISHES,
  type PictureRecord,
  type RecordedAlarm,
  type RecordedCamera,
  type RecordedQuantity,
  type RecordedVideo,
  type RecorderOptions,
  type RecorderReport,
  type RecorderRequest,
  type VideoRecord,
} from './recorder-messages.ts';
import { type QueuedVideoFrame, VideoQueue } from './video-queue.ts';

/** How many events the writer may hold, and how many may wait for it. */
const LIMITS = { underWay: 256, waiting: 4096 };
/** The same for pictures: 16 MB of the largest that are sent. */
const PICTURE_LIMITS = { underWay: 4, waiting: 24 };
/** The same for frames of videos: some seconds of eight cameras. */
const VIDEO_LIMITS = { underWay: 64, waiting: 512, waitingBytes: 16 * 1024 * 1024 };

type AlarmState = Extract<EventRecord, { type: 'alarm' }>['state'];
/** A picture of a camera as it was coded for operators. Its bytes must not be changed any more. */
export type CodedVideoFrame = QueuedVideoFrame & Pick<VideoRecord, 'format'>;
type VideoItem = CodedVideoFrame & Pick<VideoRecord, 'sequence' | 'to'>;

/**
 * The main thread's end of a recording, and of a server that shows the same to live viewers. The capture thread has its
 * own, {@link clouds}.
 */
export class SessionRecorder {
  /** For the capture thread, which makes a `CloudTap` of it. */
  readonly clouds: MessagePort;
  /** Called when a file reaches its maximum size: it is then closed and complete. */
  onFull: (() => void) | null = null;
  /** Called if nothing more can be written to a file. The robot continues. */
  onFailure: ((error: RecordingError) => void) | null = null;
  /** Called when a video can go on with a key frame only, or should have one again. */
  onKeyFrameNeeded: ((video: number) => void) | null = null;
  /** Called when live viewers want something else. */
  onLiveWishes: (() => void) | null = null;
  /** What is written to, one after another. */
  readonly file: RecordedFile;
  /** Clouds and pictures that could not be converted to messages. */
  faults = 0;
  #cloudsDropped = { captured: 0, sent: 0 };
  /** What live viewers subscribe to. */
  liveWishes = NO_LIVE_WISHES;
  /** What the live server did so far; `null` before its first report, or if there is none. */
  liveReport: LiveReport | null = null;
  /** The port on which live viewers connect, or why they cannot; `null` if they are not served. */
  readonly live: { port: number } | { failed: string } | null;
  readonly #worker: Worker;
  readonly #events: CreditQueue<EventRecord>;
  readonly #pictures: CreditQueue<Omit<PictureRecord, 'dropped'>>;
  readonly #videos: VideoQueue<VideoItem>;
  readonly #sequences = new Map<string, number>();
  #videoCount = 0;
  /** Topics with reports of components. */
  readonly #components = new Set<string>();
  #closing = false;

  private constructor(
    worker: Worker,
    clouds: MessagePort,
    path: string | null,
    live: SessionRecorder['live'],
  ) {
    this.#worker = worker;
    this.file = new RecordedFile(path, (request) => this.#post(request));
    // Each video of a file begins with a key frame.
    this.file.onOpened = () => {
      for (let video = 0; video < this.#videoCount; video++) this.#videos.skip(video);
    };
    this.live = live;
    this.clouds = clouds;
    this.#events = new CreditQueue(LIMITS, (event) => this.#post(event));
    this.#pictures = new CreditQueue(PICTURE_LIMITS, (picture) => this.#postPicture(picture));
    this.#videos = new VideoQueue(VIDEO_LIMITS, (frame) => this.#postVideo(frame));
    this.#videos.onKeyFrameNeeded = (video) => this.onKeyFrameNeeded?.(video);
    worker.on('message', (report: RecorderReport) => this.#onReport(report));
    worker.on('error', (error) => {
      this.file.die();
      this.#fail(error instanceof Error ? error.message : String(error));
    });
  }

  /** @throws {RecordingError} if the file already exists or cannot be created */
  static async open(options: RecorderOptions): Promise<SessionRecorder> {
    const { port1, port2 } = new MessageChannel();
    const worker = new Worker(new URL('./recorder-worker.ts', import.meta.url), {
      name: 'recorder',
      workerData: { ...options, clouds: port2 },
      transferList: [port2],
    });
    const { path } = options;
    const live = await new Promise<SessionRecorder['live']>((resolve, reject) => {
      worker.once('error', (error) =>
        reject(
          new RecordingError('unreadable', error instanceof Error ? error.message : String(error), {
            ...(path === null ? {} : { file: path }),
            cause: error,
          }),
        ),
      );
      worker.once('message', (report: RecorderReport) =>
        resolve(report.type === 'ready' ? report.live : null),
      );
    });
    worker.removeAllListeners('error');
    return new SessionRecorder(worker, port1, path, live);
  }

  /** What was not recorded because the writer did not keep up. */
  get dropped(): Readonly<Record<DropKind, number>> {
    return {
      ...this.#cloudsDropped,
      pictures: this.#pictures.dropped,
      videos: this.#videos.dropped,
      events: this.#events.dropped,
    };
  }

  /** The cameras whose pictures are recorded: call once, before the first picture. */
  cameras(cameras: readonly RecordedCamera[]): void {
    this.#post({ type: 'cameras', cameras: cameras.map(({ name, ofCloud }) => ({ name, ofCloud })) });
  }

  /** A picture as it is sent to operators. @param file its memory belongs to the recorder from now on */
  picture(camera: number, capturedAtMs: number, format: PictureFormat, file: Uint8Array<ArrayBuffer>): void {
    if (!this.writing && !this.liveWishes.pictures.includes(camera)) return;
    const sequence = this.#next(`picture ${camera}`);
    this.#pictures.push({ type: 'picture', camera, capturedAtMs, sequence, format, file });
  }

  /** The cameras whose videos are recorded: call once, before the first frame. */
  videos(videos: readonly RecordedVideo[]): void {
    this.#videoCount = videos.length;
    this.#post({ type: 'videos', videos: videos.map(({ name, format }) => ({ name, format })) });
  }

  /**
   * A frame of a video as it was coded for operators. Its format may differ from that of the frames before from a key
   * frame on.
   *
   * @param record whether it belongs into the file, too
   */
  video(frame: CodedVideoFrame, record = true): void {
    const { video } = frame;
    const to = { file: record && this.writing, live: this.liveWishes.videos.includes(video) };
    if (!to.file && !to.live) {
      this.#videos.skip(video);
      return;
    }
    const sequence = this.#next(`video ${video}`);
    this.#videos.push({ ...frame, sequence, to });
  }

  /** Whether anybody gets events of this kind. If not, they need not be made. */
  takes(kind: EventKind): boolean {
    return this.writing || this.liveWishes.events.includes(kind);
  }

  json(kind: JsonKind, timeMs: number, value: object): void {
    if (this.takes(kind))
      this.#events.push({ type: 'json', kind, timeMs, value, sequence: this.#next(kind) });
  }

  /** Records the velocity that the wheels were given. */
  velocity(timeMs: number, twist: Twist): void {
    if (!this.takes('velocity')) return;
    this.#events.push({ type: 'velocity', timeMs, twist, sequence: this.#next('velocity') });
  }

  /** Marks an instant that somebody wants to find again. @param by who wants it @param text says which, for people */
  bookmark(timeMs: number, by: string, text: string): void {
    if (!this.takes('bookmark')) return;
    this.#events.push({ type: 'bookmark', timeMs, by, text, sequence: this.#next('bookmark') });
  }

  /** Records the robot's pose and velocity. */
  state(timeMs: number, pose: Pose, twist: Twist): void {
    if (!this.takes('state')) return;
    this.#events.push({ type: 'state', timeMs, pose, twist, sequence: this.#next('state') });
  }

  /** The quantities and alarms that are recorded: call once, before the first sample or alarm. */
  telemetry(quantities: readonly RecordedQuantity[], alarms: readonly RecordedAlarm[]): void {
    this.#post({
      type: 'telemetry',
      quantities: quantities.map(({ topic, field, label, unit }) => ({ topic, field, label, unit })),
      alarms: alarms.map(({ watches, label }) => ({ watches, label })),
    });
  }

  /** Records a quantity's value. @param quantity position in the list @param timeMs when it was measured */
  sample(quantity: number, timeMs: number, value: number): void {
    if (!this.takes('sample')) return;
    const sequence = this.#next(`sample ${quantity}`);
    this.#events.push({ type: 'sample', timeMs, quantity, value, sequence });
  }

  /** Records an alarm. @param alarm position in the list @param timeMs when it changed, or when it is repeated */
  alarm(alarm: number, timeMs: number, { level, text, value, limit, unit, sinceMs }: AlarmState): void {
    if (!this.takes('alarm')) return;
    const state = { level, text, value, limit, unit, sinceMs };
    this.#events.push({ type: 'alarm', timeMs, alarm, state, sequence: this.#next(`alarm ${alarm}`) });
  }

  /** Records the reports of all components of a topic. @param timeMs when the newest came */
  diagnostics(topic: string, timeMs: number, reports: readonly DiagnosticReport[]): void {
    if (!this.#components.has(topic)) {
      this.#components.add(topic);
      this.#post({ type: 'components', topic });
    }
    if (!this.takes('diagnostics')) return;
    const sequence = this.#next(`diagnostics ${topic}`);
    this.#events.push({ type: 'diagnostics', timeMs, topic, reports, sequence });
  }

  /** Writes what waits, and the index. Close the capture thread first. */
  async close(): Promise<void> {
    if (this.#closing) return;
    this.#closing = true;
    this.liveWishes = NO_LIVE_WISHES;
    this.#events.drain();
    this.#pictures.drain();
    this.#videos.drain();
    const ended = new Promise((resolve) => this.#worker.once('exit', resolve));
    this.#post({ type: 'close' });
    await ended;
  }

  /** Whether what comes is still written to a file: until it is full, cannot be written, or is closed. */
  get writing(): boolean {
    return this.file.writing && !this.#closing;
  }

  #onReport(report: RecorderReport): void {
    if (report.type === 'done') this.#queues[report.kind].done();
    else if (report.type === 'written') {
      this.file.onReport(report);
      this.faults = report.faults;
      this.#cloudsDropped = report.dropped;
    } else if (report.type === 'fileOpened' || report.type === 'fileClosed') this.file.onReport(report);
    else if (report.type === 'full') {
      this.file.onReport(report);
      this.onFull?.();
    } else if (report.type === 'failed') this.#fail(report.detail);
    else if (report.type === 'wishes') {
      this.liveWishes = this.#closing ? NO_LIVE_WISHES : report.wishes;
      this.onLiveWishes?.();
    } else if (report.type === 'keyFrame') this.onKeyFrameNeeded?.(report.video);
    else if (report.type === 'live') this.liveReport = report;
  }

  #post(request: RecorderRequest): void {
    this.#worker.postMessage(request);
  }

  #postPicture(picture: Omit<PictureRecord, 'dropped'>): void {
    const record: PictureRecord = { ...picture, dropped: this.#pictures.dropped };
    this.#worker.postMessage(record, [picture.file.buffer]);
  }

  #postVideo({ bytes, ...frame }: VideoItem): void {
    // The encoder's output is also on its way to operators. (A Buffer's own `slice` would not copy.)
    const own = new Uint8Array(bytes);
    const record: VideoRecord = { ...frame, type: 'video', bytes: own, dropped: this.#videos.dropped };
    this.#worker.postMessage(record, [own.buffer]);
  }

  get #queues() {
    return { events: this.#events, pictures: this.#pictures, videos: this.#videos };
  }

  #next(kind: string): number {
    const sequence = this.#sequences.get(kind) ?? 0;
    this.#sequences.set(kind, sequence + 1);
    return sequence;
  }

  #fail(detail: string): void {
    const error = this.file.failed(detail);
    if (error !== null) this.onFailure?.(error);
  }
}
