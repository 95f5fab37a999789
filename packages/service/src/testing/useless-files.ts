/** Files that an option may name and that hold nothing: what is in them, and what people must be told. */
import { chmodSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from './folder.ts';

export interface UselessFile {
  readonly what: string;
  readonly path: string;
  /** In the refusal, beside the path. */
  readonly words: string;
}

/** Makes one of each kind, in a folder of their own: see {@link useFolder}. */
export function uselessFiles(): UselessFile[] {
  const folder = useFolder();
  const holding = (what: string, content: string | Uint8Array, words: string): UselessFile => {
    const path = join(folder, what.replaceAll(' ', '-'));
    writeFileSync(path, content);
    return { what, path, words };
  };
  const files = [
    { what: 'missing', path: join(folder, 'missing'), words: 'does not exist' },
    holding('empty', '', 'is empty'),
    holding('blank', ' \r\n\t\n', 'is empty'),
    holding('only a byte order mark', '\uFEFF', 'is empty'),
    holding('UTF-16', Buffer.from('\uFEFF{}', 'utf16le'), 'is in UTF-16'),
    holding('binary', Buffer.from([1, 0, 2]), 'is not text'),
    { what: 'a folder', path: join(folder, 'folder'), words: 'is a folder' },
  ];
  mkdirSync(join(folder, 'folder'));
  // Nothing is unreadable for root.
  if (process.getuid?.() === 0) return files;
  const unreadable = holding('unreadable', '{}', 'is not accessible to this user');
  chmodSync(unreadable.path, 0o000);
  return [...files, unreadable];
}
