import { readRevocations } from '@farpoint/grants';
import { MAX_REVOCATIONS_LENGTH } from '@farpoint/protocol';
import { type Logger, WatchedText } from '@farpoint/service';

export interface RevocationFilesOptions {
  readonly paths: readonly string[];
  readonly log: Logger;
  /** A list is there, or has changed. */
  readonly onChange: (list: string) => void;
}

/**
 * The lists of revoked grants that robots are sent, in files that may change at any time. Only the robots verify them: a
 * file that is missing, cut short or no list changes nothing.
 */
export class RevocationFiles {
  readonly #lists = new Map<string, string>();
  readonly #files: readonly WatchedText[];

  constructor({ paths, log, onChange }: RevocationFilesOptions) {
    this.#files = paths.map(
      (path) =>
        new WatchedText({
          path,
          // And a line's end.
          maxBytes: MAX_REVOCATIONS_LENGTH + 2,
          onText: (text) => {
            const list = text.trim();
            const { keyId, payload } = readRevocations(list);
            this.#lists.set(path, list);
            const { seq, grants, subjects } = payload;
            log.info(
              { path, keyId, seq, grants: grants.length, subjects: subjects.length },
              'revocations read',
            );
            onChange(list);
          },
          onFault: (detail) =>
            log.warn({ detail }, 'revocations cannot be read: what was read before is sent'),
        }),
    );
  }

  /** The newest of each file. */
  get lists(): Iterable<string> {
    return this.#lists.values();
  }

  /** Resolves when each file has been read once. */
  async start(): Promise<void> {
    await Promise.all(this.#files.map((file) => file.start()));
  }

  close(): void {
    for (const file of this.#files) file.close();
  }
}
