/** Processor time of processes by thread, from /proc (Linux). */
import { readdirSync, readFileSync } from 'node:fs';
import { isWithin, parseStat, readProcesses } from './cpu-time.ts';

/** A process, and everything that it started. */
export interface ProcessTree {
  /** What the first process is called in the figures. */
  name: string;
  pid: number;
}

/** What Chromium's processes are called in the figures, by their `--type`. */
const CHROMIUM_PROCESSES: Readonly<Record<string, string>> = {
  renderer: 'page',
  'gpu-process': 'graphics',
  utility: 'browser',
  zygote: 'browser',
};

/** What threads are called in the figures, by the beginning of their names. Other names stand for themselves. */
const THREADS: readonly (readonly [beginning: string, name: string])[] = [
  ['V8Worker', 'garbage and compiler'],
  ['DedicatedWorker', 'workers'],
  ['WebRTC', 'WebRTC'],
  ['Compositor', 'compositor'],
  ['VizCompositor', 'compositor'],
  ['Thread<', 'software renderer'],
  ['WorkerThread', 'worker'],
];

/** Threads that take less are added up. */
export const OTHER_THREADS = 'other threads';

/**
 * Seconds of processor time so far, by `process: thread`.
 *
 * @returns `null` without /proc
 */
export function threadSeconds(trees: readonly ProcessTree[]): Map<string, number> | null {
  const processes = readProcesses();
  if (processes === null) return null;
  const seconds = new Map<string, number>();
  for (const pid of processes.keys()) {
    const tree = trees.find((candidate) => isWithin(pid, candidate.pid, processes));
    if (tree === undefined) continue;
    const process = processName(read(`/proc/${pid}/cmdline`) ?? '', tree.name);
    for (const thread of list(`/proc/${pid}/task`)) {
      const stat = read(`/proc/${pid}/task/${thread}/stat`);
      if (stat === null) continue;
      const name = thread === String(pid) ? 'main thread' : threadName(stat);
      const key = `${process}: ${name}`;
      seconds.set(key, (seconds.get(key) ?? 0) + parseStat(stat).seconds);
    }
  }
  return seconds;
}

/** What a process is called: Chromium's by its type, others as the tree that they belong to. */
export function processName(commandLine: string, tree: string): string {
  const type = /--type=([a-z-]+)/.exec(commandLine)?.[1];
  return type === undefined ? tree : (CHROMIUM_PROCESSES[type] ?? tree);
}

/** What a thread is called, by the line that /proc has about it. */
export function threadName(stat: string): string {
  const name = stat.slice(stat.indexOf('(') + 1, stat.lastIndexOf(')'));
  return THREADS.find(([beginning]) => name.startsWith(beginning))?.[1] ?? name.replace(/[\d/]+$/, '').trim();
}

/**
 * Milliseconds for each of `frames` frames between two readings, by thread, the most first. What takes less than
 * `leastMs` is added up by process.
 */
export function perFrame(
  before: ReadonlyMap<string, number>,
  after: ReadonlyMap<string, number>,
  frames: number,
  leastMs = 0,
): Map<string, number> {
  const result = new Map<string, number>();
  for (const [key, seconds] of after) {
    // A thread that ended meanwhile took its time with it.
    const ms = (Math.max(0, seconds - (before.get(key) ?? 0)) * 1000) / Math.max(frames, 1);
    const name = ms < leastMs ? `${key.split(':')[0]}: ${OTHER_THREADS}` : key;
    result.set(name, (result.get(name) ?? 0) + ms);
  }
  return new Map([...result].sort(([, a], [, b]) => b - a));
}

/** `null`: the process has ended meanwhile, or there is no such file here. */
function read(path: string): string | null {
  try {
    return readFileSync(path, 'utf8');
  } catch {
    return null;
  }
}

function list(path: string): string[] {
  try {
    return readdirSync(path);
  } catch {
    return [];
  }
}
