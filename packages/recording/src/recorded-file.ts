import { RecordingError } from './errors.ts';
import type { RecorderReport, RecorderRequest } from './recorder-messages.ts';

/** The file that a recorder's thread writes, one after another, as the main thread knows it. */
export class RecordedFile {
  /** Of the file that is being written, or was written last; `null`: of none. */
  path: string | null;
  /** Called when another file is begun. */
  onOpened: (() => void) | null = null;
  readonly #post: (request: RecorderRequest) => void;
  #ended = false;
  /** Nothing can be written any more. */
  #dead = false;
  #opening: PromiseWithResolvers<void> | null = null;
  #closing: PromiseWithResolvers<void> | null = null;
  /** In the files before. */
  #before = { messages: 0, bytes: 0 };
  #written = { messages: 0, bytes: 0 };

  /** @param path of the file that the thread begins with; `null` if it begins with none */
  constructor(path: string | null, post: (request: RecorderRequest) => void) {
    this.path = path;
    this.#post = post;
  }

  /** Until it is full, cannot be written, or is closed. */
  get writing(): boolean {
    return this.path !== null && !this.#ended;
  }

  /** In all files so far. */
  get messages(): number {
    return this.#before.messages + this.#written.messages;
  }

  /** Of all files so far. */
  get bytes(): number {
    return this.#before.bytes + this.#written.bytes;
  }

  /** Of the file that is being written, or was written last, bytes. */
  get size(): number {
    return this.#written.bytes;
  }

  /** @throws {RecordingError} if one is being written, or this one exists already or cannot be created */
  async open(path: string): Promise<void> {
    const refusal = (why: string) => new RecordingError('unreadable', why, { file: path });
    if (this.#dead) throw refusal('nothing can be recorded any more');
    if (this.writing || this.#opening !== null) throw refusal('another file is being written');
    this.#opening = Promise.withResolvers();
    this.#post({ type: 'openFile', path });
    try {
      await this.#opening.promise;
    } catch (error) {
      throw refusal(error instanceof Error ? error.message : String(error));
    } finally {
      this.#opening = null;
    }
  }

  /** Completes it, if one is being written. @throws {RecordingError} if it cannot be completed */
  async close(): Promise<void> {
    if (!this.writing) return;
    this.#ended = true;
    this.#closing = Promise.withResolvers();
    this.#post({ type: 'closeFile' });
    try {
      await this.#closing.promise;
    } catch (error) {
      throw this.#error(error instanceof Error ? error.message : String(error));
    } finally {
      this.#closing = null;
    }
  }

  /** Nothing more is written, to any file. */
  die(): void {
    this.#dead = true;
  }

  /** @returns the error that somebody must be told; `null` if whoever asked is told, or it is known */
  failed(detail: string): RecordingError | null {
    const asked = this.#opening ?? this.#closing;
    asked?.reject(new Error(detail));
    if (asked !== null || this.#ended) return null;
    this.#ended = true;
    return this.#error(`recording stopped: ${detail}`);
  }

  onReport(report: RecorderReport & { type: 'fileOpened' | 'fileClosed' | 'full' | 'written' }): void {
    switch (report.type) {
      case 'fileOpened':
        this.#onOpened(report);
        break;
      case 'fileClosed':
        this.#closing?.resolve();
        break;
      case 'full':
        this.#ended = true;
        break;
      case 'written':
        this.#written = { messages: report.messages, bytes: report.bytes };
    }
  }

  #onOpened({ path, failed }: RecorderReport & { type: 'fileOpened' }): void {
    if (failed !== null) {
      this.#opening?.reject(new Error(failed));
      return;
    }
    this.#before = { messages: this.messages, bytes: this.bytes };
    this.#written = { messages: 0, bytes: 0 };
    this.path = path;
    this.#ended = false;
    this.onOpened?.();
    this.#opening?.resolve();
  }

  #error(detail: string): RecordingError {
    return new RecordingError('unreadable', detail, this.path === null ? {} : { file: this.path });
  }
}
