/**
 * How somebody at the robot asks the running robot to release its emergency stop: by a file in the robot's state folder.
 * Only the robot's user and root can write there, and nothing from the network comes that way.
 */
import { rmSync, unlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

export class ReleaseRequest {
  readonly #path: string;

  /** @param robotId names the file, because robots on one machine may share the folder */
  constructor(folder: string, robotId: string) {
    this.#path = join(folder, `${robotId}.release`);
  }

  /** @throws {Error} of the system */
  make(): void {
    this.withdraw();
    // What stands there by then is a link of the robot's user, perhaps to a file of root's: it is not followed.
    writeFileSync(this.#path, '', { mode: 0o640, flag: 'wx' });
  }

  /** Forgets a request that nobody has taken. @throws {Error} of the system */
  withdraw(): void {
    rmSync(this.#path, { force: true });
  }

  /** @returns whether there was one; it is used up */
  take(): boolean {
    try {
      unlinkSync(this.#path);
      return true;
    } catch {
      return false;
    }
  }
}
