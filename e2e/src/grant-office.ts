/** Issues grants by the real command, as whoever runs a fleet does. */
import { execFile } from 'node:child_process';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { programPath } from '@farpoint/local-stack';

const run = promisify(execFile);
const program = programPath('signaling');

export interface GrantOrder {
  name: string;
  role: 'watch' | 'drive' | 'supervise';
  robots?: string;
  /** Thumbprint of the operator's key; without it, a ticket is made. */
  forKey?: string;
  days?: number;
  robotKey?: string;
}

export class GrantOffice {
  /** The public keys, for `--grant-keys`. */
  readonly keys: string;
  /** The private key, which signs. */
  readonly secretKey: string;

  private constructor(folder: string) {
    this.keys = join(folder, 'grant-keys.json');
    this.secretKey = join(folder, 'grant-key.json');
  }

  /** @param folder an empty one */
  static async open(folder: string): Promise<GrantOffice> {
    const office = new GrantOffice(folder);
    await run(process.execPath, [
      program,
      'grant',
      'keygen',
      '--key',
      office.secretKey,
      '--keys',
      office.keys,
    ]);
    return office;
  }

  /** @returns a grant, or a ticket if no key was given */
  async issue({ name, role, robots = '*', forKey, days = 1, robotKey }: GrantOrder): Promise<string> {
    const { stdout } = await run(process.execPath, [
      ...[program, 'grant', 'issue', '--key', this.secretKey],
      ...['--name', name, '--role', role, '--robots', robots, '--days', String(days)],
      ...(forKey === undefined ? ['--with-key'] : ['--for', forKey]),
      ...(robotKey === undefined ? [] : ['--robot-key', robotKey]),
    ]);
    return stdout.trim();
  }
}
