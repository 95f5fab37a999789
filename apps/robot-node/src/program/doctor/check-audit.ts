/** Checks the audit log: whether the robot can write it, and whether it is as it was written. */
import { accessSync, constants, statSync } from 'node:fs';
import { dirname } from 'node:path';
import { verifyFiles } from '@farpoint/audit';
import { fail, ok, type Result, warn } from './finding.ts';

/** @param path undefined if nothing is recorded */
export function checkAudit(path: string | undefined): Result[] {
  if (path === undefined) return [];
  const folder = dirname(path);
  if (!(statSync(folder, { throwIfNoEntry: false })?.isDirectory() ?? false))
    return [fail(`${folder} is not a folder`, 'create it, or set audit.log')];
  // A full file is renamed, and a new one begins.
  if (!may(folder, constants.W_OK))
    return [fail(`${folder} is not writable`, 'make the robot’s user its owner')];
  const found = statSync(path, { throwIfNoEntry: false });
  if (found === undefined || found.size === 0) return [ok(`${path} will be created`)];
  if (!found.isFile()) return [fail(`${path} is not a regular file`, 'remove it, or set audit.log')];
  if (!may(path, constants.R_OK | constants.W_OK))
    return [
      fail(`${path} is not writable for user ${process.getuid?.()}`, 'make the robot’s user its owner'),
    ];
  // Older files may be elsewhere.
  const verified = verifyFiles([path], { partial: true });
  if (!('kind' in verified)) return [ok(`${path}: ${verified.entries} entries, as written`)];
  if (verified.kind === 'torn')
    return [ok(`${path}: the last entry is torn by a crash, which the next start records`)];
  return [
    warn(
      `${path} is not as it was written: line ${verified.place.line}: ${verified.detail}`,
      'keep a copy, and find out who could write it; the robot goes on with the chain',
    ),
  ];
}

function may(path: string, mode: number): boolean {
  try {
    accessSync(path, mode);
    return true;
  } catch {
    return false;
  }
}
