/** Helpers for this package's tests. */
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { isAvailable } from '../addon.ts';
import { SharedMemoryError, type SharedMemoryErrorCode } from '../errors.ts';

/** Tests that need the addon are skipped without it, and then name the command that builds it. */
export const ADDON_SUITE = { skip: !isAvailable(), note: 'needs the addon: pnpm build:native' };

/** A new folder, in shared memory if there is any. */
export function scratchFolder(): string {
  return mkdtempSync(join(existsSync('/dev/shm') ? '/dev/shm' : tmpdir(), 'farpoint-test-'));
}

export function removeFolder(folder: string): void {
  rmSync(folder, { recursive: true, force: true });
}

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

/** Resolves once `is` returns true; another thread or process changes its result. */
export async function until(is: () => boolean): Promise<void> {
  while (!is()) await new Promise((resolve) => setTimeout(resolve, 1));
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
