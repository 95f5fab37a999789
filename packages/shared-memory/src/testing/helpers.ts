/** Helpers for this package's tests. */
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { testFolder, useFolder } from '@farpoint/service/testing/folder';
import { isAvailable } from '../addon.ts';
import { SharedMemoryError, type SharedMemoryErrorCode } from '../errors.ts';

/** Tests that need the addon are skipped without it, and then name the command that builds it. */
export const ADDON_SUITE = { skip: !isAvailable(), note: 'needs the addon: pnpm build:native' };

const MEMORY = existsSync('/dev/shm') ? '/dev/shm' : tmpdir();
/** A folder in shared memory, if there is any: for the test that runs, or for all of the file. */
export const scratchFolder = (): string => testFolder(MEMORY);
export const scratchFolderOfFile = (): string => useFolder(MEMORY);

export function fromHex(hex: string): Uint8Array {
  return new Uint8Array(Buffer.from(hex, 'hex'));
}

export function toHex(bytes: Uint8Array): string {
  return Buffer.from(bytes).toString('hex');
}

export function readVectors<T>(name: string): T {
  return JSON.parse(readFileSync(join(import.meta.dirname, '..', '..', 'vectors', name), 'utf8')) as T;
}

/** The error that an action throws. */
export function errorOf(action: () => unknown): SharedMemoryError {
  try {
    action();
  } catch (error) {
    if (error instanceof SharedMemoryError) return error;
    throw error;
  }
  throw new Error('it was accepted');
}

export function codeOf(action: () => unknown): SharedMemoryErrorCode {
  return errorOf(action).code;
}

const root = join(import.meta.dirname, '..', '..', '..', '..');
export const EXAMPLES = join(root, 'examples');

/** A Python with numpy, as `pnpm test` finds or installs it, or `null`. */
export function findPython(): string | null {
  const candidates = [
    process.env.FARPOINT_PYTHON,
    join(root, '.farpoint', 'python', 'bin', 'python3'),
    'python3',
  ];
  return candidates.find((python) => python !== undefined && runs(python, '-c', 'import numpy')) ?? null;
}

/** Whether a program exists and exits successfully. */
export function runs(program: string, ...args: string[]): boolean {
  return spawnSync(program, args, { stdio: 'ignore' }).status === 0;
}
