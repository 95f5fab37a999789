/**
 * Remembers revoked and blocked grants across restarts of the robot, so that neither a restart nor a signaling service
 * that no longer sends a list gives anybody back what was taken.
 */
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { RevocationsRefusedError, readRevocations } from '@farpoint/grants';
import { makeFolder, replaceFile } from '@farpoint/service';
import { z } from 'zod';

/** A grant that a supervisor has blocked at this robot. */
const blockedSchema = z.strictObject({
  keyId: z.string().max(128),
  id: z.string().max(64),
  /** When the grant ends, seconds since 1970. */
  expiresAtS: z.number().min(0),
});
export type BlockedGrant = z.infer<typeof blockedSchema>;

/** As many keys as a robot may meet in its life; those that count now are far fewer. */
export const MAX_LISTS = 64;
export const MAX_BLOCKED = 1024;

const stateSchema = z.strictObject({
  version: z.literal(1),
  /** Compact JWS, one for each key. */
  lists: z.array(z.string()).max(MAX_LISTS),
  blocked: z.array(blockedSchema).max(MAX_BLOCKED),
});
export type RevocationState = Omit<z.infer<typeof stateSchema>, 'version'>;

/** What the robot remembered cannot be used: nobody can tell who was revoked. */
export class RevocationJournalError extends Error {
  override readonly name = 'RevocationJournalError';
}

export class RevocationJournal {
  /** What was remembered when the journal was opened. */
  readonly start: RevocationState;
  readonly #path: string;

  /**
   * @param folder created when something is written
   * @param robotId names the file, because robots on one machine may share the folder
   * @throws {RevocationJournalError} if there is something that cannot be read
   */
  constructor(folder: string, robotId: string) {
    this.#path = join(folder, `${robotId}.revocations.json`);
    this.start = read(this.#path);
  }

  /** @throws {Error} of the system; what was written before is then still there */
  write({ lists, blocked }: RevocationState): void {
    makeFolder(dirname(this.#path), 0o750);
    replaceFile(this.#path, `${JSON.stringify({ version: 1, lists, blocked })}\n`, 0o640);
  }
}

function read(path: string): RevocationState {
  let text: string;
  try {
    text = readFileSync(path, 'utf8');
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'ENOENT') return { lists: [], blocked: [] };
    throw new RevocationJournalError(`${path}: ${(error as Error).message}`);
  }
  try {
    const { lists, blocked } = stateSchema.parse(JSON.parse(text));
    lists.forEach(readRevocations);
    return { lists, blocked };
  } catch (error) {
    const known = error instanceof z.ZodError || error instanceof SyntaxError;
    if (!known && !(error instanceof RevocationsRefusedError)) throw error;
    throw new RevocationJournalError(`${path} is not what a robot writes`);
  }
}
