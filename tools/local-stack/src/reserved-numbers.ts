/**
 * Reserves numbers that programs on this machine must not share: ports, ranges of ports, domains.
 *
 * Each reservation is an empty file with the number and the process in its name. A process that has ended holds nothing:
 * whoever meets its file removes it, and cannot remove anybody else's.
 */
import { closeSync, mkdirSync, openSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir, userInfo } from 'node:os';
import { join } from 'node:path';

export interface NumberRange {
  /** What the numbers are, as in a file's name. */
  kind: string;
  first: number;
  /** Included. */
  last: number;
  /** Distance of two numbers that may be reserved; 1 if absent. */
  step?: number;
}

const FOLDER = join(tmpdir(), `farpoint-reserved-${userInfo().uid}`);

/**
 * Reserves a number until this process ends.
 *
 * @param isUsable refuses a number that something else on the machine uses
 * @throws {Error} if all are taken
 */
export async function reserveNumber(
  range: NumberRange,
  isUsable: (number: number) => boolean | Promise<boolean> = () => true,
): Promise<number> {
  for (const number of candidates(range)) {
    if (!tryReserve(range.kind, number)) continue;
    if (await isUsable(number)) return number;
    release(range.kind, number);
  }
  throw noneLeft(range);
}

/** The same at once. */
export function reserveNumberNow(range: NumberRange): number {
  for (const number of candidates(range)) if (tryReserve(range.kind, number)) return number;
  throw noneLeft(range);
}

/** All of the range once. Processes begin at different ones, so that they seldom meet. */
function* candidates({ first, last, step = 1 }: NumberRange): Generator<number> {
  const count = Math.floor((last - first) / step) + 1;
  const begin = (process.pid * 31) % count;
  for (let i = 0; i < count; i++) yield first + ((begin + i) % count) * step;
}

const fileOf = (kind: string, number: number, pid: number) => join(FOLDER, `${kind}-${number}.${pid}`);

/** What this process holds; its files go with it. */
const held = new Set<string>();
process.once('exit', () => {
  for (const file of held) rmSync(file, { force: true });
});

/**
 * Two processes that try at the same time may both fail, but never both succeed: each looks for others after its own file
 * is there.
 *
 * @returns whether the number is this caller's now; nobody in this process has it twice
 */
export function tryReserve(kind: string, number: number): boolean {
  if (!isSwept) sweep();
  const own = fileOf(kind, number, process.pid);
  // A file of this process that is not in `held` is one of its threads', or of a process that had its number before.
  if (held.has(own)) return false;
  try {
    closeSync(openSync(own, 'wx'));
  } catch {
    return false;
  }
  held.add(own);
  for (const name of readdirSync(FOLDER)) {
    const pid = name.startsWith(`${kind}-${number}.`) ? pidOf(name) : process.pid;
    if (pid === process.pid) continue;
    if (isRunning(pid)) {
      release(kind, number);
      return false;
    }
    rmSync(join(FOLDER, name), { force: true });
  }
  return true;
}

let isSwept = false;
/** Removes what processes have left that were killed. */
function sweep(): void {
  isSwept = true;
  mkdirSync(FOLDER, { recursive: true, mode: 0o700 });
  const running = new Map<number, boolean>();
  for (const name of readdirSync(FOLDER)) {
    const pid = pidOf(name);
    const runs = running.get(pid) ?? isRunning(pid);
    running.set(pid, runs);
    if (!runs) rmSync(join(FOLDER, name), { force: true });
  }
}

const pidOf = (name: string) => Number(name.split('.').at(-1));

function release(kind: string, number: number): void {
  const own = fileOf(kind, number, process.pid);
  held.delete(own);
  rmSync(own, { force: true });
}

function isRunning(pid: number): boolean {
  try {
    process.kill(pid, 0);
    return true;
  } catch (error) {
    return (error as NodeJS.ErrnoException).code === 'EPERM';
  }
}

function noneLeft({ kind, first, last }: NumberRange): Error {
  return new Error(`no ${kind} from ${first} to ${last} is left; who holds them is in ${FOLDER}`);
}
