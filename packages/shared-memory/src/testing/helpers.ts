/** Helpers for this package's tests. */
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { testFolder, useFolder } from '@farpoint/service/testing/folder';
import { thrown } from '@farpoint/service/testing/thrown';
import { isAvailable } from '../addon.ts';
import type { FrameRoom } from '../cloud/cloud-reader.ts';
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

/** A command block, and what it says. */
export interface ControlVector {
  counter: number;
  linear: [number, number, number];
  angular: [number, number, number];
  hex: string;
}
export const controlVectors = (): ControlVector[] =>
  readVectors<{ control: ControlVector[] }>('reference.json').control;

/** Memory for frames of so many points, whatever their form. */
export function roomFor(points: number): FrameRoom {
  return {
    points: new Float32Array(points * 4),
    depth: new Float32Array(points),
    colour: new Uint32Array(points),
  };
}

/** Flags for C and C++ that let nothing doubtful pass. */
const STRICT = ['-Wall', '-Wextra', '-Wpedantic', '-Werror', '-O2'];

/** @param folder where the binary goes @returns the command that runs it */
export function compile(folder: string, compiler: string, args: readonly string[], source: string): string[] {
  const binary = join(folder, `${compiler}-${basename(source)}`);
  const { status, stderr } = spawnSync(compiler, [...args, ...STRICT, source, '-o', binary], {
    encoding: 'utf8',
  });
  if (status !== 0) throw new Error(stderr);
  return [binary];
}

/** The error that an action throws. */
export const errorOf = (action: () => unknown): SharedMemoryError => thrown(SharedMemoryError, action);

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
