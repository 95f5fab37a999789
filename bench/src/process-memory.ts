/** Memory of Chromium's processes, from /proc (Linux). */
import { readdirSync, readFileSync } from 'node:fs';
import { isDescendant } from './cpu-time.ts';

/**
 * Proportional set size of a browser's processes of one type: pages that processes share count in parts.
 *
 * @param browserPid process id of the browser
 * @param type as in Chromium's `--type=`: `renderer`, `gpu-process`
 * @returns MB, or `null` without /proc
 */
export function memoryMbOf(browserPid: number, type: string): number | null {
  let names: string[];
  try {
    names = readdirSync('/proc').filter((name) => /^\d+$/.test(name));
  } catch {
    return null;
  }
  let bytes = 0;
  for (const name of names) {
    try {
      if (!readFileSync(`/proc/${name}/cmdline`, 'utf8').includes(`--type=${type}`)) continue;
      if (!isDescendant(Number(name), browserPid)) continue;
      bytes += pssBytes(readFileSync(`/proc/${name}/smaps_rollup`, 'utf8'));
    } catch {
      // The process has ended meanwhile.
    }
  }
  return Number((bytes / 1e6).toFixed(1));
}

/** proc(5): the line `Pss` of smaps_rollup, in KiB. */
export function pssBytes(rollup: string): number {
  return Number(/^Pss:\s+(\d+) kB$/m.exec(rollup)?.[1] ?? 0) * 1024;
}
