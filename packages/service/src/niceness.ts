import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { setPriority } from 'node:os';
import type { Logger } from './logger.ts';

/**
 * Sets the niceness of this process, with all its threads: on Linux each thread has its own, which a thread that it
 * starts inherits (setpriority(2)). Those of V8 and libuv exist before any script runs, and the main thread waits for
 * them, at a collection of garbage for instance. Linux schedules sessions against each other before their processes (sched(7),
 * autogroup), so a process that leads its own session also sets the session's niceness.
 *
 * @throws {Error} if the system does not permit it
 */
export function setNiceness(niceness: number): void {
  setPriority(niceness);
  let stat: string;
  let threads: number[];
  try {
    stat = readFileSync('/proc/self/stat', 'utf8');
    threads = readdirSync('/proc/self/task').map(Number);
  } catch {
    return; // Not Linux.
  }
  for (const thread of threads) setPriorityOf(thread, niceness);
  // After the name, which may contain any characters: state, parent, process group, session.
  const session = Number(stat.slice(stat.lastIndexOf(')') + 2).split(' ')[3]);
  if (session !== process.pid) return;
  try {
    writeFileSync('/proc/self/autogroup', String(niceness));
  } catch (error) {
    // On a kernel without autogroups there is nothing to set.
    if ((error as NodeJS.ErrnoException).code !== 'ENOENT') throw error;
  }
}

/** Sets it if the system permits it, and says so if not. @param cost what that costs: the end of a sentence */
export function setNicenessIfPermitted(niceness: number, log: Logger, cost = ''): void {
  try {
    setNiceness(niceness);
  } catch (error) {
    log.info({ niceness, reason: (error as Error).message }, `the system keeps the priority${cost}`);
  }
}

function setPriorityOf(thread: number, niceness: number): void {
  try {
    setPriority(thread, niceness);
  } catch (error) {
    // A thread may end meanwhile.
    if ((error as { info?: { code?: string } }).info?.code !== 'ESRCH') throw error;
  }
}
