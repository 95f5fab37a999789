/**
 * The link to a producer that may come and go: opens its files when they appear, watches them, and reopens them when
 * they are replaced.
 */
import { type MappedFile, SharedMemoryError, Watch, type WatchOrder } from '@farpoint/shared-memory';

/**
 * Interval between attempts to find a missing producer, ms. Chosen: a producer that starts is found before
 * somebody wonders, for five cheap calls a second.
 */
const RETRY_MS = 200;

export interface ProducerFiles {
  /** False once the files have been replaced. */
  readonly current: boolean;
  close(): void;
}

export interface ProducerLinkOptions<Files extends ProducerFiles> {
  /** @throws {SharedMemoryError} */
  open(): Files;
  place(files: Files): { file: MappedFile; offset: number; futex: boolean };
  /** What to wait for next. @throws {SharedMemoryError} */
  order(files: Files): WatchOrder;
  onReady(): void;
  /** Called when the files cannot be used as they are. The link keeps trying. */
  onFault(error: SharedMemoryError): void;
}

export class ProducerLink<Files extends ProducerFiles> {
  readonly #options: ProducerLinkOptions<Files>;
  #files: Files | null;
  #watch: Watch | null = null;
  #retry: NodeJS.Timeout | null = null;
  #closed = false;

  /** @param files already opened */
  constructor(files: Files, options: ProducerLinkOptions<Files>) {
    this.#options = options;
    this.#files = files;
    this.#startWatch(files);
    this.waitForNext();
  }

  /** `null` while there is no producer. */
  get files(): Files | null {
    return this.#files;
  }

  /** Call this once a frame has been taken or skipped. */
  waitForNext(): void {
    if (this.#files === null) return;
    try {
      this.#watch?.arm(this.#options.order(this.#files));
    } catch (error) {
      this.lost(error);
    }
  }

  /** Takes an error that was thrown while the files were used. Rethrows it unless it is a fault of the files. */
  lost(error: unknown): void {
    if (!(error instanceof SharedMemoryError)) throw error;
    this.#options.onFault(error);
    this.#letGo();
    this.#retry ??= setTimeout(() => this.#reopen(), RETRY_MS);
  }

  close(): void {
    this.#closed = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.#letGo();
  }

  #startWatch(files: Files): void {
    const { file, offset, futex } = this.#options.place(files);
    this.#watch = new Watch(file, { offset, futex }, (outcome) => {
      if (outcome === 'changed') this.#options.onReady();
      else if (outcome === 'timeout' && files.current) this.waitForNext();
      else this.#reopen();
    });
  }

  #reopen(): void {
    this.#retry = null;
    this.#letGo();
    if (this.#closed) return;
    try {
      this.#files = this.#options.open();
      this.#startWatch(this.#files);
    } catch (error) {
      this.lost(error);
      return;
    }
    this.waitForNext();
  }

  #letGo(): void {
    this.#watch?.close();
    this.#watch = null;
    this.#files?.close();
    this.#files = null;
  }
}

/**
 * Opens a producer's files as soon as they exist.
 *
 * @throws {SharedMemoryError} the last fault, if they cannot be opened in time; `unavailable` immediately
 */
export async function openWhenThere<Files>(open: () => Files, waitMs: number): Promise<Files> {
  const deadline = performance.now() + waitMs;
  for (;;) {
    try {
      return open();
    } catch (error) {
      const hopeless = !(error instanceof SharedMemoryError) || error.code === 'unavailable';
      if (hopeless || performance.now() >= deadline) throw error;
    }
    await new Promise((resolve) => setTimeout(resolve, Math.min(RETRY_MS, waitMs)));
  }
}
