import { createWriteStream, type WriteStream } from 'node:fs';

/** Lines of JSON to a file, in the order in which they come. A file that does not keep up loses lines, counted. */
export class StatisticsFile {
  readonly #stream: WriteStream;
  readonly #onError: (error: Error) => void;
  dropped = 0;

  constructor(path: string, onError: (error: Error) => void) {
    this.#onError = onError;
    this.#stream = createWriteStream(path);
    this.#stream.on('error', (error) => this.#onError(error));
  }

  write(line: object): void {
    if (this.#stream.writableLength > 1 << 22) this.dropped++;
    else this.#stream.write(`${JSON.stringify(line)}\n`);
  }

  close(): Promise<void> {
    return new Promise((resolve) => {
      if (this.#stream.errored !== null) resolve();
      else this.#stream.end(() => resolve());
    });
  }
}
