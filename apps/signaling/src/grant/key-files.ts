import { readFileSync, renameSync, writeFileSync } from 'node:fs';
import { GrantKeysError, type GrantPublicJwk, MAX_KEYS, readJwkSet } from '@farpoint/grants';
import { fileFault } from '@farpoint/service';
import { CommandError } from './command-rim.ts';

/** @throws {CommandError} */
export function readText(flag: string, path: string): string {
  try {
    return readFileSync(path, 'utf8');
  } catch (error) {
    throw new CommandError(`${flag} cannot be read: ${fileFault(error) ?? String(error)}`, 1);
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

/** @throws {CommandError} */
export function writePublicKeys(flag: string, path: string, keys: readonly GrantPublicJwk[]): void {
  writeWhole(flag, path, `${JSON.stringify({ keys }, null, 2)}\n`);
}

/** `null` if the file does not exist. @throws {CommandError} */
export function readIfThere(flag: string, path: string): string | null {
  try {
    return readFileSync(path, 'utf8');
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'ENOENT') return null;
    throw new CommandError(`${flag} cannot be read: ${fileFault(error) ?? String(error)}`, 1);
  }
}

/** Replaces a public file at once, so that nobody ever reads half of it. @throws {CommandError} */
export function writeWhole(flag: string, path: string, text: string): void {
  const beside = `${path}.new`;
  try {
    writeFileSync(beside, text, { mode: 0o644, flush: true });
    renameSync(beside, path);
  } catch (error) {
    throw new CommandError(`${flag} cannot be written: ${fileFault(error) ?? String(error)}`, 1);
  }
}
