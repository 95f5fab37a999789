/**
 * The remembered world, for a page: picks key frames from the clouds that come, has a worker keep the surfaces that were
 * seen, and hands the changed ones to whoever draws them.
 */
import type { Batch } from '../cloud/batch.ts';
import { KEY_FRAME_BYTES, KeyFrame } from './key-frame.ts';
import { KeyFrameFeed } from './key-frame-feed.ts';
import type { FromMemoryWorker, MemoryStats, ToMemoryWorker } from './memory-messages.ts';
import { MemoryPages } from './memory-pages.ts';
import type { PointFileFormat } from './point-file.ts';
import type { MotionLimits } from './pose-jump.ts';
import { TOP_VIEW_BYTES, TopView, type TopViewArea } from './top-view.ts';

/** Key frames that may be on their way to the worker. */
const FRAMES = 3;

/** Draws what is remembered, e.g. `MemoryView` of `@farpoint/cloud-view`. */
export interface MemoryListener {
  /** Pages have changed. They are valid during the call only. */
  onPages(pages: MemoryPages): void;
  /** Everything was forgotten. */
  onForgotten(): void;
}

/** A file was not read; the message says why. */
export class MemoryFileError extends Error {
  /** `MemoryFileError` */
  override readonly name = 'MemoryFileError';
}

/** Remembers the surfaces that a robot's sensors have seen. */
export class WorldMemory {
  /** Figures of the memory; `null` before the first frame. */
  stats: MemoryStats | null = null;
  /** Whether clouds are taken. What is remembered stays until {@link forget}. */
  enabled = true;
  /** Draws what is remembered. */
  listener: MemoryListener | null = null;
  /** Gets what {@link lookFromAbove} asked for. The view is valid during the call only. */
  onTopView: ((view: TopView) => void) | null = null;
  readonly #worker: Worker;
  readonly #beganMs = performance.now();
  readonly #feeds = new Map<number, KeyFrameFeed>();
  readonly #free = Array.from({ length: FRAMES }, () => new KeyFrame(new ArrayBuffer(KEY_FRAME_BYTES)));
  readonly #asked = new Map<
    number,
    { done(value: ArrayBuffer | number): void; failed(error: Error): void }
  >();
  #tickets = 0;
  /** `null` while it is on its way. */
  #topView: ArrayBuffer | null = new ArrayBuffer(TOP_VIEW_BYTES);

  /** Starts the worker. */
  constructor() {
    this.#worker = new Worker(new URL('./memory-worker.ts', import.meta.url), { type: 'module' });
    this.#worker.onmessage = ({ data }: MessageEvent<FromMemoryWorker>) => this.#onMessage(data);
  }

  /** What the robot can drive: poses that it cannot have reached by itself make the memory forget. */
  set limits(limits: MotionLimits) {
    this.#post({ type: 'limits', limits });
  }

  /**
   * Looks at a batch of points or tiles, of any sensor, and copies what it keeps of it. Call it before the batch is
   * released, for example in a listener of the `cloud` event that was added before a view's.
   */
  take(batch: Batch): void {
    if (!this.enabled || batch.buffer.byteLength === 0) return;
    let feed = this.#feeds.get(batch.sensor);
    if (feed === undefined) {
      feed = new KeyFrameFeed({
        takeFrame: () => this.#free.pop() ?? null,
        sendFrame: ({ buffer }) => this.#post({ type: 'frame', buffer }, [buffer]),
      });
      this.#feeds.set(batch.sensor, feed);
    }
    feed.take(batch, this.#nowMs);
  }

  /** Forgets everything: another robot, or another session whose poses may mean other places. */
  forget(): void {
    for (const feed of this.#feeds.values()) {
      const frame = feed.abandon();
      if (frame !== null) this.#free.push(frame);
    }
    this.#post({ type: 'forget' });
  }

  /** Has everything handed on again, e.g. after the GPU's context was lost. */
  resend(): void {
    this.#post({ type: 'resend' });
  }

  /** Has what is remembered around a place handed to {@link onTopView} soon, unless that is on its way already. */
  lookFromAbove(area: TopViewArea): void {
    const buffer = this.#topView;
    if (buffer === null) return;
    this.#topView = null;
    this.#post({ type: 'topView', buffer, area, nowMs: this.#nowMs }, [buffer]);
  }

  /** Milliseconds since the memory began, which is when its clock begins. */
  get #nowMs(): number {
    return performance.now() - this.#beganMs;
  }

  /** Now, on the clock of surfels' ages, seconds since the memory began. */
  get nowS(): number {
    return this.#nowMs / 1000;
  }

  /** Everything that is remembered, as a file. @throws {MemoryFileError} where the code for files cannot be loaded */
  async save(format: PointFileFormat = 'ply'): Promise<ArrayBuffer> {
    const savedAt = new Date().toISOString();
    return (await this.#ask((ticket) => ({
      type: 'save',
      ticket,
      nowMs: this.#nowMs,
      savedAt,
      format,
    }))) as ArrayBuffer;
  }

  /**
   * Remembers what is in a binary PLY or a PCD file, which {@link save} or another program has written, beside what is remembered
   * already. Its places are those of the robot's world when it was saved.
   *
   * @param agoS how long ago the file was written, seconds
   * @returns the number of points that were added
   * @throws {MemoryFileError} says what is wrong with the file
   */
  async load(bytes: ArrayBuffer, agoS: number): Promise<number> {
    const ask = (ticket: number): ToMemoryWorker => ({
      type: 'load',
      ticket,
      nowMs: this.#nowMs,
      agoS,
      bytes,
    });
    return (await this.#ask(ask, [bytes])) as number;
  }

  /** Ends the worker. */
  close(): void {
    this.#worker.terminate();
  }

  #ask(
    message: (ticket: number) => ToMemoryWorker,
    transfer: Transferable[] = [],
  ): Promise<ArrayBuffer | number> {
    const ticket = this.#tickets++;
    return new Promise((done, failed) => {
      this.#asked.set(ticket, { done, failed });
      this.#post(message(ticket), transfer);
    });
  }

  #post(message: ToMemoryWorker, transfer: Transferable[] = []): void {
    this.#worker.postMessage(message, transfer);
  }

  #onMessage(message: FromMemoryWorker): void {
    switch (message.type) {
      case 'pages':
        this.listener?.onPages(new MemoryPages(message.buffer, message.count));
        this.#post({ type: 'return', buffer: message.buffer }, [message.buffer]);
        return;
      case 'forgotten':
        this.listener?.onForgotten();
        return;
      case 'taken':
        this.stats = message.stats;
        this.#free.push(new KeyFrame(message.buffer));
        return;
      case 'topView': {
        const view = new TopView(message.buffer);
        Object.assign(view, { x: message.x, y: message.y, oldestS: message.oldestS });
        this.#topView = message.buffer;
        this.onTopView?.(view);
        return;
      }
      case 'saved':
        this.#answer(message.ticket)?.done(message.bytes);
        return;
      case 'loaded':
        this.#answer(message.ticket)?.done(message.points);
        return;
      case 'refused':
        this.#answer(message.ticket)?.failed(new MemoryFileError(message.message));
    }
  }

  #answer(ticket: number) {
    const asked = this.#asked.get(ticket);
    this.#asked.delete(ticket);
    return asked;
  }
}
