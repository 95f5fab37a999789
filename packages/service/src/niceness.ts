import { readFileSync, writeFileSync } from 'node:fs';
import { setPriority } from 'node:os';

/**
 * Sets the niceness of this process. Linux weighs whole sessions against each other before their processes (sched(7),
 * autogroup), so a process that leads its own session sets that one's too.
 *
 * @throws {Error} where the system does not let it
 */
export function setNiceness(niceness: number): void {
  setPriority(niceness);
  let stat: string;
  try {
    stat = readFileSync('/proc/self/stat', 'utf8');
  } catch {
    return; // Not Linux.
  }
  // After the name, which may hold anything: state, parent, process group, session.
  const session = Number(stat.slice(stat.lastIndexOf(')') + 2).split(' ')[3]);
  if (session !== process.pid) return;
  try {
    writeFileSync('/proc/self/autogroup', String(niceness));
  } catch (error) {
    // A kernel without autogroups has nothing to set.
    if ((error as NodeJS.ErrnoException).code !== 'ENOENT') throw error;
  }
}
