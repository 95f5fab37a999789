/** Translates the system's errors about files and sockets into words that people can act on. */

/** The system error, wherever it is in the chain of causes; `null` if there is none. */
export function systemErrorOf(error: unknown): NodeJS.ErrnoException | null {
  for (let at: unknown = error, depth = 0; at instanceof Error && depth < 8; at = at.cause, depth++) {
    const { code, syscall } = at as NodeJS.ErrnoException;
    if (typeof code === 'string' && typeof syscall === 'string') return at as NodeJS.ErrnoException;
  }
  return null;
}

const FILE_WORDS: Readonly<Record<string, string>> = {
  ENOENT: 'does not exist',
  EEXIST: 'already exists',
  EISDIR: 'is a folder, not a file',
  ENOTDIR: 'is not a folder, or not inside one',
  EACCES: 'is not accessible to this user',
  EPERM: 'is not accessible to this user',
  EROFS: 'is on a read-only file system',
  ENOSPC: 'cannot be written: the disk is full',
  EMFILE: 'cannot be opened: too many open files',
};

/**
 * One sentence about a file, without the system's own name for the fault if there is a plain one.
 *
 * @param path for faults that name no path, as those of reading an open file
 */
export function fileFault(error: unknown, path?: string): string | null {
  const found = systemErrorOf(error);
  const named = found?.path ?? path;
  if (found === null || named === undefined || found.syscall === 'listen') return null;
  const words = FILE_WORDS[found.code ?? ''];
  return words === undefined ? null : `${named} ${words}`;
}

/** Where a program could not listen. */
export interface ListenFault {
  readonly code: string;
  readonly host: string;
  readonly port: number;
}

/** `null` if the error is about something else. */
export function listenFault(error: unknown): ListenFault | null {
  const found = systemErrorOf(error) as (NodeJS.ErrnoException & { address?: string; port?: number }) | null;
  if (found?.syscall !== 'listen' || typeof found.port !== 'number') return null;
  return { code: found.code ?? '', host: found.address ?? '', port: found.port };
}
