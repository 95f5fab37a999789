/**
 * Remembers revoked and blocked grants across restarts of the robot, so that neither a restart nor a signaling service
 * that no longer sends a list gives anybody back what was taken.
 */
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import {
  MAX_KNOWN_REVOCATIONS,
  MAX_SUBJECT_LENGTH,
  RevocationsRefusedError,
  readRevocations,
} from '@farpoint/grants';
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
/** Operators that the robot itself has blocked. Chosen: more than a robot meets, and still a short file. */
export const MAX_BLOCKED = 1024;

const dateSchema = z.int().min(0);
/** What one key has revoked, by all its lists. */
const revokedSchema = z.strictObject({
  keyId: z.string().max(128),
  /** Of the newest list. */
  sequence: z.int().min(0),
  grants: z.array(z.strictObject({ jti: z.string().max(64), exp: dateSchema })).max(MAX_KNOWN_REVOCATIONS),
  subjects: z
    .array(z.strictObject({ sub: z.string().max(MAX_SUBJECT_LENGTH), before: dateSchema, exp: dateSchema }))
    .max(MAX_KNOWN_REVOCATIONS),
});

const blocked = z.array(blockedSchema).max(MAX_BLOCKED);
const stateSchema = z.union([
  z.strictObject({ version: z.literal(2), revoked: z.array(revokedSchema).max(MAX_LISTS), blocked }),
  /** As earlier versions wrote it: the newest list of each key, in its compact form. */
  z.strictObject({ version: z.literal(1), lists: z.array(z.string()).max(MAX_LISTS), blocked }),
]);
export interface RevocationState {
  revoked: z.infer<typeof revokedSchema>[];
  blocked: BlockedGrant[];
}

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
  write({ revoked, blocked }: RevocationState): void {
    makeFolder(dirname(this.#path), 0o750);
    replaceFile(this.#path, `${JSON.stringify({ version: 2, revoked, blocked })}\n`, 0o640);
  }
}

function read(path: string): RevocationState {
  let text: string;
  try {
    text = readFileSync(path, 'utf8');
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'ENOENT') return { revoked: [], blocked: [] };
    throw new RevocationJournalError(`${path}: ${(error as Error).message}`);
  }
  try {
    const state = stateSchema.parse(JSON.parse(text));
    if (state.version === 2) return { revoked: state.revoked, blocked: state.blocked };
    const revoked = state.lists.map((list) => {
      const { keyId, payload } = readRevocations(list);
      return { keyId, sequence: payload.seq, grants: payload.grants, subjects: payload.subjects };
    });
    return { revoked, blocked: state.blocked };
  } catch (error) {
    const known = error instanceof z.ZodError || error instanceof SyntaxError;
    if (!known && !(error instanceof RevocationsRefusedError)) throw error;
    throw new RevocationJournalError(`${path} is not what a robot writes`);
  }
}
