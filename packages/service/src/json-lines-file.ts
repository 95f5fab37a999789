import { createWriteStream, type WriteStream } from 'node:fs';

/** Maximum amount of data that waits for the disk, bytes. */
const MOST_BACKLOG = 1 << 22;

/** Writes lines of JSON to a file, in order. If the disk does not keep up, lines are dropped and counted. */
export class JsonLinesFile {
  readonly #stream: WriteStream;
  dropped = 0;

  constructor(path: string, onError: (error: Error) => void) {
    this.#stream = createWriteStream(path);
    this.#stream.on('error', onError);
  }

  write(line: object): void {
    if (this.#stream.writableLength > MOST_BACKLOG) this.dropped++;
    else this.#stream.write(`${JSON.stringify(line)}\n`);
  }

  close(): Promise<void> {
    return new Promise((resolve) => {
      if (this.#stream.errored !== null) resolve();
      else this.#stream.end(() => resolve());
    });
  }
}
