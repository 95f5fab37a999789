import { missingFrom, type RevocationEntries, readRevocations } from '@farpoint/grants';
import { MAX_REVOCATIONS_LENGTH } from '@farpoint/protocol';
import { type Logger, WatchedText } from '@farpoint/service';

export interface RevocationFilesOptions {
  readonly paths: readonly string[];
  readonly log: Logger;
  /** A list is there, or has changed. */
  readonly onChange: (list: string) => void;
  /** Seconds since 1970. */
  readonly nowS?: () => number;
}

interface ReadList {
  readonly list: string;
  readonly keyId: string;
  readonly entries: RevocationEntries;
}

/** Earlier lists of one file that are sent still. */
const MAX_EARLIER = 8;

/**
 * The lists of revoked grants that robots are sent, in files that may change at any time. Only the robots verify them: a
 * file that is missing, cut short or no list changes nothing.
 */
export class RevocationFiles {
  /** Of each file: the newest, after those that say what it leaves out. */
  readonly #lists = new Map<string, readonly ReadList[]>();
  readonly #files: readonly WatchedText[];

  constructor({ paths, log, onChange, nowS = () => Date.now() / 1000 }: RevocationFilesOptions) {
    this.#files = paths.map(
      (path) =>
        new WatchedText({
          path,
          // And a line's end.
          maxBytes: MAX_REVOCATIONS_LENGTH + 2,
          onText: (text) => {
            const list = text.trim();
            const { keyId, payload } = readRevocations(list);
            const newest = { list, keyId, entries: payload };
            const earlier = (this.#lists.get(path) ?? []).filter(
              (each) => each.list !== list && lost(each, newest, nowS()) > 0,
            );
            this.#lists.set(path, [...earlier.slice(-MAX_EARLIER), newest]);
            const missing = earlier.reduce((sum, each) => sum + lost(each, newest, nowS()), 0);
            if (missing > 0)
              log.warn(
                { path, missing },
                'revocations: the file leaves out what is revoked still; the earlier list is sent as well',
              );
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

  /** The newest of each file, and earlier ones that say what it leaves out. */
  get lists(): Iterable<string> {
    return [...this.#lists.values()].flat().map(({ list }) => list);
  }

  /** Resolves when each file has been read once. */
  async start(): Promise<void> {
    await Promise.all(this.#files.map((file) => file.start()));
  }

  close(): void {
    for (const file of this.#files) file.close();
  }
}

/** How many entries of an earlier list still count and are not in a later one. */
function lost(earlier: ReadList, later: ReadList, nowS: number): number {
  const said = earlier.keyId === later.keyId ? later.entries : { grants: [], subjects: [] };
  return missingFrom(earlier.entries, said, nowS);
}
