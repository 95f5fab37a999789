/**
 * The last picture that this browser has drawn of each robot, small, for the list of robots. It stays in this browser: nobody
 * is sent it.
 */

/** Size of a picture, pixels. Chosen: twice that of the list's, for sharp screens. */
export const LAST_PICTURE = { width: 192, height: 108 };
/** Characters of a picture as a data URL. Chosen: 20 kB in base64; JPEG of that size takes 8. last-pictures.test.ts holds it. */
const MOST_PICTURE_CHARACTERS = 27_000;
/**
 * Of so many robots, at most; then the oldest is forgotten. Chosen: with the longest pictures, a sixth of what browsers store for a
 * site. last-pictures.test.ts holds it.
 */
const MOST_PICTURES = 32;
/** After that a picture is forgotten, ms. Chosen: what was seen the day before helps nobody. last-pictures.test.ts holds it. */
const FORGOTTEN_MS = 86_400_000;

const PREFIX = 'farpoint.picture ';
const STORED = /^(\d{1,16}) (data:image\/jpeg;base64,[A-Za-z0-9+/]+=*)$/;

/** What of the browser's storage is used. */
export type PictureStorage = Pick<Storage, 'getItem' | 'setItem' | 'removeItem' | 'key' | 'length'>;

/** A picture and when it was drawn. */
export interface LastPicture {
  /** A data URL. */
  readonly url: string;
  /** The time of day, ms. */
  readonly drawnMs: number;
}

export class LastPictures {
  readonly #origin: string;
  readonly #storage: () => PictureStorage;
  /** By key. */
  readonly #pictures = new Map<string, LastPicture>();

  /**
   * @param origin of the signaling service: another one may use the same ids
   * @param storage throws where the browser keeps nothing; then pictures last as long as the page
   */
  constructor(origin: string, storage: () => PictureStorage, unixMs: number) {
    this.#origin = origin;
    this.#storage = storage;
    this.#withStorage((stored) => {
      for (const key of keysOf(stored)) {
        const picture = parsePicture(stored.getItem(key));
        if (picture === null) stored.removeItem(key);
        else this.#pictures.set(key, picture);
      }
    });
    this.#forget(unixMs);
  }

  /** @param url a JPEG as a data URL; what is too long is not kept */
  keep(robotId: string, url: string, unixMs: number): void {
    const picture = parsePicture(`${Math.round(unixMs)} ${url}`);
    if (picture === null) return;
    const key = this.#key(robotId);
    this.#pictures.set(key, picture);
    this.#forget(unixMs);
    this.#withStorage((stored) => stored.setItem(key, `${picture.drawnMs} ${picture.url}`));
  }

  of(robotId: string): LastPicture | null {
    return this.#pictures.get(this.#key(robotId)) ?? null;
  }

  #key(robotId: string): string {
    return `${PREFIX}${this.#origin} ${robotId}`;
  }

  #forget(unixMs: number): void {
    const oldest = [...this.#pictures].sort(([, a], [, b]) => a.drawnMs - b.drawnMs);
    for (const [i, [key, { drawnMs }]] of oldest.entries()) {
      if (i >= oldest.length - MOST_PICTURES && unixMs - drawnMs < FORGOTTEN_MS) continue;
      this.#pictures.delete(key);
      this.#withStorage((stored) => stored.removeItem(key));
    }
  }

  #withStorage(act: (storage: PictureStorage) => void): void {
    try {
      act(this.#storage());
    } catch {
      // Private browsing, or no room: pictures last as long as the page.
    }
  }
}

function keysOf(storage: PictureStorage): string[] {
  const keys = Array.from({ length: storage.length }, (_, i) => storage.key(i));
  return keys.filter((key): key is string => key?.startsWith(PREFIX) === true);
}

function parsePicture(text: string | null): LastPicture | null {
  if (text === null || text.length > MOST_PICTURE_CHARACTERS) return null;
  const [, drawnMs, url] = STORED.exec(text) ?? [];
  return drawnMs === undefined || url === undefined ? null : { url, drawnMs: Number(drawnMs) };
}
