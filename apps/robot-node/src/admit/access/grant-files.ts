import type { RobotOptions } from '../../program/robot-configuration.ts';
import { GrantKeysFile } from './grant-keys-file.ts';
import { RevocationJournal } from './revocation-journal.ts';

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
}: Pick<RobotOptions, 'grantKeys' | 'revocations' | 'stateFolder' | 'id'>): Promise<GrantFiles | null> {
  if (grantKeys === undefined) return null;
  const keys = await GrantKeysFile.open(grantKeys);
  return { keys, journal: new RevocationJournal(stateFolder, id), revocations };
}
