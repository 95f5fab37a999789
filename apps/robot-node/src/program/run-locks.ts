/**
 * Keeps two running robots from writing the same files: each would undo what the other remembers, such as its emergency
 * stop. The kernel frees the locks when the process ends, however it ends.
 */
import { dirname, join } from 'node:path';
import { type Logger, makeFolder, StartFailure } from '@farpoint/service';
import { FileInUseError, isAvailable, MappedFile } from '@farpoint/shared-memory';
import type { RobotOptions } from './robot-configuration.ts';

interface Claim {
  path: string;
  /** What another robot has, for people. */
  what: string;
  remedy: string;
}

/**
 * Claims what only one robot may write, until the process ends or it is disposed of. Where files cannot be locked, the
 * robot goes on and says so.
 *
 * @throws {StartFailure} if another robot that runs has claimed it
 */
export function lockRun(
  { id, stateFolder, audit }: Pick<RobotOptions, 'id' | 'stateFolder' | 'audit'>,
  log: Logger,
): Disposable {
  const claims: Claim[] = [
    {
      path: join(stateFolder, `${id}.lock`),
      what: `another robot with the id ${id} runs with the state folder ${stateFolder}`,
      remedy: 'end that robot, or give this one an id of its own (--id) or a folder of its own (--state-dir)',
    },
  ];
  if (audit !== undefined)
    claims.push({
      path: `${audit.path}.lock`,
      what: `another robot writes the audit log ${audit.path}`,
      remedy: 'end that robot, or give this one a log of its own (--audit-log)',
    });
  const held: MappedFile[] = [];
  const release = () => {
    for (const file of held.splice(0)) file.close();
  };
  try {
    for (const claim of claims) {
      const file = take(claim, log);
      if (file !== null) held.push(file);
    }
  } catch (error) {
    release();
    throw error;
  }
  return { [Symbol.dispose]: release };
}

function take({ path, what, remedy }: Claim, log: Logger): MappedFile | null {
  const unlocked = (detail: string) => {
    log.warn({ path, detail }, 'cannot be locked: nothing keeps another robot from writing the same files');
    return null;
  };
  if (!isAvailable()) return unlocked('the shared-memory addon is not available');
  let file: MappedFile | null = null;
  try {
    makeFolder(dirname(path), 0o750);
    file = MappedFile.open(path, { bytes: 1, create: true });
    file.claim(remedy);
    return file;
  } catch (error) {
    file?.close();
    if (error instanceof FileInUseError)
      throw new StartFailure(error.holder === null ? what : `${what} (process ${error.holder})`, remedy, {
        cause: error,
      });
    return unlocked((error as Error).message);
  }
}
