import { closeSync, openSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { GrantKeysError, type GrantPublicJwk, MAX_KEYS, readJwkSet } from '@farpoint/grants';
import { fileFault, readTextFile, replaceFile, TextFileError } from '@farpoint/service';
import { CommandError } from './command-rim.ts';

/** @throws {CommandError} */
export function readText(flag: string, path: string): string {
  try {
    return readTextFile(path);
  } catch (error) {
    if (error instanceof TextFileError) throw new CommandError(`${flag} ${error.message}`, 1);
    throw error;
  }
}

/** Writes a new file that only its owner can read. Never overwrites one. @throws {CommandError} */
export function writeSecret(flag: string, path: string, text: string): void {
  try {
    writeFileSync(path, text, { flag: 'wx', mode: 0o600 });
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'EEXIST')
      throw new CommandError(`${flag} ${path} already exists, and a key is never overwritten`, 1);
    throw new CommandError(`${flag} cannot be written: ${fileFault(error) ?? String(error)}`, 1);
  }
}

/** The public keys in a file; none if it does not exist yet. @throws {CommandError} */
export function readPublicKeys(flag: string, path: string): GrantPublicJwk[] {
  const text = readIfThere(flag, path);
  if (text === null) return [];
  try {
    const keys = readJwkSet(text);
    if (keys.length === MAX_KEYS)
      throw new CommandError(`${flag} ${path} has ${MAX_KEYS} keys: remove one that is not used any more`, 1);
    return keys;
  } catch (error) {
    if (error instanceof GrantKeysError) throw new CommandError(`${flag} ${path} ${error.message}`, 1);
    throw error;
  }
}

/** Replaces the file at once, so that a robot never reads half of it. @throws {CommandError} */
export function writePublicKeys(flag: string, path: string, keys: readonly GrantPublicJwk[]): void {
  try {
    replaceFile(path, `${JSON.stringify({ keys }, null, 2)}\n`, 0o644);
  } catch (error) {
    throw new CommandError(`${flag} cannot be written: ${fileFault(error) ?? String(error)}`, 1);
  }
}

/** `null` if the file does not exist. @throws {CommandError} */
export function readIfThere(flag: string, path: string): string | null {
  try {
    return readTextFile(path);
  } catch (error) {
    if (!(error instanceof TextFileError)) throw error;
    if (error.code === 'ENOENT') return null;
    throw new CommandError(`${flag} ${error.message}`, 1);
  }
}

/** A public file that is being written anew. */
export interface Draft {
  /** Replaces the file at once, so that nobody ever reads half of it. @throws {CommandError} */
  publish(text: string): void;
  /** Leaves the file as it is, unless it was published. */
  drop(): void;
}

/**
 * Begins to write a file anew. Until then nobody else can, so that of two commands neither undoes what the other did.
 *
 * @throws {CommandError}
 */
export function openDraft(flag: string, path: string): Draft {
  const beside = `${path}.new`;
  const fault = (error: unknown) =>
    new CommandError(`${flag} cannot be written: ${fileFault(error) ?? String(error)}`, 1);
  let file: number;
  try {
    file = openSync(beside, 'wx', 0o644);
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code !== 'EEXIST') throw fault(error);
    const detail = 'another command is writing it. If none runs any more, remove that file';
    throw new CommandError(`${flag}: ${beside} exists: ${detail}`, 1);
  }
  let open = true;
  return {
    publish(text) {
      try {
        writeFileSync(file, text, { flush: true });
        closeSync(file);
        renameSync(beside, path);
        open = false;
      } catch (error) {
        throw fault(error);
      }
    },
    drop() {
      if (open) rmSync(beside, { force: true });
    },
  };
}
