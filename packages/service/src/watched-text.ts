import { readFile, stat } from 'node:fs/promises';
import { fileFault } from './system-error.ts';
import { TextFileError, textOfFile } from './text-file.ts';

export interface WatchedTextOptions {
  readonly path: string;
  /** A longer file is a fault. */
  readonly maxBytes: number;
  /** Default: 250. */
  readonly intervalMs?: number | undefined;
  /** Called with the text, first and whenever it has changed. An exception is a fault of the file. */
  readonly onText: (text: string) => void;
  /** Called once while a fault lasts. What was read before stays in force. */
  readonly onFault: (detail: string) => void;
}

/**
 * A small text file that others may write, replace or remove at any time. It is read again and again and compared: that
 * finds every change on every file system, whichever way the file was written.
 */
export class WatchedText {
  readonly #options: WatchedTextOptions;
  #seen: string | null = null;
  #fault: string | null = null;
  #timer: NodeJS.Timeout | null = null;
  #closed = false;
  #checking: Promise<void> | null = null;

  constructor(options: WatchedTextOptions) {
    this.#options = options;
  }

  /** Reads the file now, then again and again until {@link close} is called. Resolves when it was read once. */
  async start(): Promise<void> {
    await this.check();
    if (this.#closed) return;
    this.#timer = setTimeout(() => void this.start(), this.#options.intervalMs ?? 250);
  }

  /** Reads the file now. Never rejects. */
  check(): Promise<void> {
    this.#checking ??= this.#read().finally(() => {
      this.#checking = null;
    });
    return this.#checking;
  }

  close(): void {
    this.#closed = true;
    if (this.#timer !== null) clearTimeout(this.#timer);
  }

  async #read(): Promise<void> {
    const { path, maxBytes, onText } = this.#options;
    let text: string;
    try {
      const found = await stat(path);
      if (!found.isFile()) return this.#report(`${path} is not a regular file`);
      if (found.size > maxBytes) return this.#report(`${path} is longer than ${maxBytes} bytes`);
      text = textOfFile(path, await readFile(path));
    } catch (error) {
      if (error instanceof TextFileError) return this.#report(`${path} ${error.fault}`);
      return this.#report(fileFault(error) ?? String(error));
    }
    this.#fault = null;
    if (this.#closed || text === this.#seen) return;
    this.#seen = text;
    try {
      onText(text);
    } catch (error) {
      this.#report(`${path}: ${(error as Error).message}`);
    }
  }

  #report(detail: string): void {
    if (this.#closed || detail === this.#fault) return;
    this.#fault = detail;
    this.#options.onFault(detail);
  }
}
