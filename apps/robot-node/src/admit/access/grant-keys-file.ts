import { type GrantKeys, GrantKeysError, parseGrantKeys } from '@farpoint/grants';
import { readTextFile, TextFileError } from '@farpoint/service';

/** The JWK set with the keys whose grants count, in a file that can be read again. */
export class GrantKeysFile {
  #keys: GrantKeys;
  readonly #path: string;

  private constructor(path: string, keys: GrantKeys) {
    this.#path = path;
    this.#keys = keys;
  }

  /** @throws {GrantKeysError} also if the file cannot be read */
  static async open(path: string): Promise<GrantKeysFile> {
    return new GrantKeysFile(path, await read(path));
  }

  get keys(): GrantKeys {
    return this.#keys;
  }

  /** Reads the file again. The old keys stay in force if that fails. @throws {GrantKeysError} */
  async reload(): Promise<void> {
    this.#keys = await read(this.#path);
  }
}

async function read(path: string): Promise<GrantKeys> {
  try {
    // A JWK set is a few kilobytes.
    return await parseGrantKeys(readTextFile(path));
  } catch (error) {
    if (error instanceof TextFileError)
      throw new GrantKeysError(error.code === null ? `${path} ${error.fault}` : error.message);
    if (error instanceof GrantKeysError) throw new GrantKeysError(`${path} ${error.message}`);
    throw error;
  }
}
