/** Where an authority is kept between two starts: a folder that only its user can read. */
import { linkSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { type Authority, AuthorityError, makeAuthority, readAuthority } from './authority.ts';

/** Certificate and key in one file, so that they are written, and read, together. */
const FILE = 'authority.pem';

/**
 * Opens the authority of a folder; makes one there if there is none.
 *
 * @throws {AuthorityError} if what is there is no authority, or expired
 * @throws {Error} of the file system
 */
export async function openAuthority(
  folder: string,
  { name, now }: { name: string; now: Date },
): Promise<Authority> {
  const path = join(folder, FILE);
  const text = textOf(path);
  if (text !== null) return checked(text, now);
  mkdirSync(folder, { recursive: true, mode: 0o700 });
  const made = await makeAuthority({ name, now });
  const fresh = `${path}.${process.pid}`;
  writeFileSync(fresh, `${made.certificate}${made.key}`, { mode: 0o600, flag: 'wx' });
  try {
    // Of two programs that start together, the first one's stays.
    linkSync(fresh, path);
    return made;
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code !== 'EEXIST') throw error;
    return checked(readFileSync(path, 'utf8'), now);
  } finally {
    rmSync(fresh, { force: true });
  }
}

function textOf(path: string): string | null {
  try {
    return readFileSync(path, 'utf8');
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'ENOENT') return null;
    throw error;
  }
}

const BLOCK = /-----BEGIN ([A-Z ]+)-----[^-]+-----END \1-----\n?/g;

async function checked(text: string, now: Date): Promise<Authority> {
  const blocks = [...text.matchAll(BLOCK)];
  const block = (label: string) => blocks.find(([, found]) => found === label)?.[0];
  const certificate = block('CERTIFICATE');
  const key = block('PRIVATE KEY');
  if (certificate === undefined || key === undefined)
    throw new AuthorityError({
      kind: 'unreadable',
      detail: `there is no ${certificate === undefined ? 'certificate' : 'private key'} in it`,
    });
  const authority = { certificate, key };
  await readAuthority(authority, now);
  return authority;
}
