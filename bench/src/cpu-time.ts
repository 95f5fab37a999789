/** Processor time of a process and all its descendants, from /proc (Linux). */
import { readdirSync, readFileSync } from 'node:fs';

/** Linux reports in units of 1/100 s on every architecture that Node runs on. */
const TICKS_PER_SECOND = 100;

export interface ProcessTimes {
  parent: number;
  seconds: number;
}

/** @returns seconds of processor time so far, or `null` without /proc */
export function cpuSecondsOfTree(pid: number): number | null {
  const processes = readProcesses();
  if (processes === null) return null;
  let sum = 0;
  for (const [candidate, { seconds }] of processes) if (isWithin(candidate, pid, processes)) sum += seconds;
  return sum;
}

/**
 * Of a process's main thread, the one that runs JavaScript's event loop.
 *
 * @returns seconds of processor time so far, or `null` without /proc
 */
export function cpuSecondsOfMainThread(pid: number): number | null {
  try {
    return parseStat(readFileSync(`/proc/${pid}/task/${pid}/stat`, 'utf8')).seconds;
  } catch {
    return null;
  }
}

/** Whether a process was started by another, or by one that was; so it is of itself. `false` without /proc. */
export function isDescendant(pid: number, ancestor: number): boolean {
  return isWithin(pid, ancestor, readProcesses() ?? new Map());
}

/** Whether a process is another, or was started by it, at any remove. */
export function isWithin(
  pid: number,
  ancestor: number,
  processes: ReadonlyMap<number, ProcessTimes>,
): boolean {
  for (let at = pid; at > 1; at = processes.get(at)?.parent ?? 0) if (at === ancestor) return true;
  return false;
}

/** All processes, by their ids; `null` without /proc. */
export function readProcesses(): Map<number, ProcessTimes> | null {
  let names: string[];
  try {
    names = readdirSync('/proc').filter((name) => /^\d+$/.test(name));
  } catch {
    return null;
  }
  const processes = new Map<number, ProcessTimes>();
  for (const name of names) {
    try {
      processes.set(Number(name), parseStat(readFileSync(`/proc/${name}/stat`, 'utf8')));
    } catch {
      // The process has ended meanwhile.
    }
  }
  return processes;
}

/** proc(5): the fields after the name, which is in brackets and may contain anything. */
export function parseStat(stat: string): ProcessTimes {
  const fields = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
  const [parent, user, system] = [fields[1], fields[11], fields[12]].map(Number) as [number, number, number];
  return { parent, seconds: (user + system) / TICKS_PER_SECOND };
}

/** Mean number of cores used between two readings; `null` without /proc. */
export function coresBetween(before: number | null, after: number | null, elapsedMs: number): number | null {
  return before === null || after === null
    ? null
    : Number(((after - before) / (elapsedMs / 1000)).toFixed(3));
}
