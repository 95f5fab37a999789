import { GrantKeysFile } from './grant-keys-file.ts';
import { RevocationJournal } from './revocation-journal.ts';

export interface GrantOptions {
  /** File with the keys whose grants admit operators; if undefined, everybody is admitted. */
  grantKeys?: string | undefined;
  /** Files with lists of revoked grants, besides those from the signaling service. */
  revocations: readonly string[];
  /** Where the robot remembers revoked grants across restarts. */
  stateFolder: string;
  /** Of the robot. */
  id: string;
}

/** The files by which a robot decides whom it admits. */
export interface GrantFiles {
  keys: GrantKeysFile;
  journal: RevocationJournal;
  /** Paths of the robot's own lists of revoked grants. */
  revocations: readonly string[];
}

/**
 * @returns `null` if the robot asks for no grants
 * @throws {GrantKeysError}
 * @throws {RevocationJournalError}
 */
export async function openGrantFiles({
  grantKeys,
  revocations,
  stateFolder,
  id,
}: GrantOptions): Promise<GrantFiles | null> {
  if (grantKeys === undefined) return null;
  const keys = await GrantKeysFile.open(grantKeys);
  return { keys, journal: new RevocationJournal(stateFolder, id), revocations };
}
