/** Finds the process that holds a file's lock. Linux lists the locks in /proc. */
import { readFileSync, statSync } from 'node:fs';

/**
 * @param table text of /proc/locks
 * @returns the process that holds the `flock` of the file, or `null` if the table does not say
 */
export function holderIn(table: string, file: { dev: number; ino: number }): number | null {
  const wanted = `${deviceName(file.dev)}:${file.ino}`;
  for (const line of table.split('\n')) {
    // 1: FLOCK  ADVISORY  WRITE 1234 00:1a:567 0 EOF; whoever waits has an arrow after the number.
    const [, kind, , , pid, place] = line.trim().split(/\s+/);
    // A process outside this container has no number here.
    if (kind === 'FLOCK' && place === wanted && Number(pid) > 0) return Number(pid);
  }
  return null;
}

/** @returns `null` if nobody holds it, it is in another container, or the system does not tell */
export function lockHolder(path: string): number | null {
  try {
    return holderIn(readFileSync('/proc/locks', 'latin1'), statSync(path));
  } catch {
    return null;
  }
}

/** Major and minor number, as glibc packs them into one. */
function deviceName(dev: number): string {
  const packed = BigInt(dev);
  const major = ((packed >> 8n) & 0xfffn) | ((packed >> 32n) & 0xfffff000n);
  const minor = (packed & 0xffn) | ((packed >> 12n) & 0xffffff00n);
  return [major, minor].map((number) => number.toString(16).padStart(2, '0')).join(':');
}
