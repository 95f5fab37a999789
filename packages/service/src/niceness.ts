import { readFileSync, writeFileSync } from 'node:fs';
import { setPriority } from 'node:os';

/**
 * Sets the niceness of this process. Linux schedules sessions against each other before their processes (sched(7),
 * autogroup), so a process that leads its own session also sets the session's niceness.
 *
 * @throws {Error} if the system does not permit it
 */
export function setNiceness(niceness: number): void {
  setPriority(niceness);
  let stat: string;
  try {
    stat = readFileSync('/proc/self/stat', 'utf8');
  } catch {
    return; // Not Linux.
  }
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
