/** Interface of the native addon, and loading it. */
import { createRequire } from 'node:module';
import { ADDON_FILE, BUILD_REMEDY } from './build.ts';
import { SharedMemoryError } from './errors.ts';

declare const handle: unique symbol;
export interface MappingHandle {
  readonly [handle]: 'mapping';
}
export interface WatchHandle {
  readonly [handle]: 'watch';
}
export interface ControlHandle {
  readonly [handle]: 'control';
}
export type ByteView = Uint8Array | Uint32Array | Float32Array | Float64Array;

/**
 * Errors carry `code` and a number in their message. Codes: an errno name; `CLOSED`; `RANGE`: a mistake of the caller;
 * `FAULT`: the file ended at this offset; `UNSAFE`: its mode; `OWNER`: its owner’s id; `SIZE`: the actual size; `FILE`: not a regular file.
 */
export interface Addon {
  open(
    path: string,
    writable: boolean,
    create: boolean,
    exclusive: boolean,
    resize: boolean,
    bytes: number,
    mode: number,
    owner: number,
    anyOwner: boolean,
  ): MappingHandle;
  close(mapping: MappingHandle): void;
  size(mapping: MappingHandle): number;
  current(mapping: MappingHandle): boolean;
  lock(mapping: MappingHandle): boolean;
  load8(mapping: MappingHandle, offset: number): number;
  load32(mapping: MappingHandle, offset: number): number;
  store8(mapping: MappingHandle, offset: number, value: number): void;
  store32(mapping: MappingHandle, offset: number, value: number): void;
  fence(): void;
  copyOut(mapping: MappingHandle, offset: number, to: ByteView): void;
  copyIn(mapping: MappingHandle, offset: number, from: ByteView): void;
  wake(mapping: MappingHandle, offset: number): void;
  unpackPoints64(mapping: MappingHandle, offset: number, bytes: number, to: ByteView): boolean;
  images(
    mapping: MappingHandle,
    kind: number,
    depthOffset: number,
    colourOffset: number,
    pixels: number,
    unit: number,
    depth: Float32Array,
    colour: Uint32Array,
  ): void;
  watch(
    mapping: MappingHandle,
    offset: number,
    futex: boolean,
    callback: (outcome: number) => void,
  ): WatchHandle;
  arm(watch: WatchHandle, value: number, quietUs: number, pollUs: number, timeoutMs: number): void;
  unwatch(watch: WatchHandle): void;
  control(block: MappingHandle, busy: MappingHandle, silenceMs: number): ControlHandle;
  controlWrite(control: ControlHandle, velocity: Float64Array): number;
  controlSilences(control: ControlHandle): number;
  controlClose(control: ControlHandle): void;
}

let loaded: Addon | null = null;

/** @throws {SharedMemoryError} `unavailable`, with what to do about it */
export function loadAddon(): Addon {
  if (loaded !== null) return loaded;
  if (process.platform !== 'linux') throw unavailable('shared memory needs Linux');
  try {
    loaded = createRequire(import.meta.url)(ADDON_FILE) as Addon;
  } catch (error) {
    const { code } = error as NodeJS.ErrnoException;
    throw unavailable(
      code === 'MODULE_NOT_FOUND'
        ? `the shared-memory addon is not built: ${BUILD_REMEDY}`
        : `the shared-memory addon cannot be loaded (${error instanceof Error ? error.message : String(error)}): ${BUILD_REMEDY}`,
    );
  }
  return loaded;
}

/** Whether shared memory can be used on this machine. */
export function isAvailable(): boolean {
  try {
    loadAddon();
    return true;
  } catch {
    return false;
  }
}

function unavailable(detail: string): SharedMemoryError {
  return new SharedMemoryError('unavailable', '', null, detail);
}
