/** What the checks read from the machine: small files of /proc and /sys. Tests substitute a machine of their own. */
import { readdirSync, readFileSync } from 'node:fs';

export interface Host {
  /** The trimmed text; `null` if the file cannot be read. */
  read(path: string): string | null;
  /** Names in a folder; empty if it cannot be read. */
  list(path: string): string[];
}

export const thisHost: Host = {
  read(path) {
    try {
      return readFileSync(path, 'utf8').trim();
    } catch {
      return null;
    }
  },
  list(path) {
    try {
      return readdirSync(path).sort();
    } catch {
      return [];
    }
  },
};

/** A number in a file; `null` if there is none. */
export function readNumber(host: Host, path: string): number | null {
  const text = host.read(path);
  const value = Number(text);
  return text === null || text === '' || !Number.isFinite(value) ? null : value;
}

export function megabytes(bytes: number): string {
  return bytes < 1e10 ? `${Math.round(bytes / 1e6)} MB` : `${Math.round(bytes / 1e9)} GB`;
}
