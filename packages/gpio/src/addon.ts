import { createRequire } from 'node:module';
import { ADDON_FILE, BUILD_REMEDY } from './build.ts';

declare const handle: unique symbol;
export interface LineHandle {
  readonly [handle]: 'gpio line';
}

/** Errors have the name of an errno as their `code`; `CLOSED` for a handle that was closed. */
export interface Addon {
  open(chip: string, line: number, activeLow: boolean): LineHandle;
  active(line: LineHandle): boolean;
  close(line: LineHandle): void;
}

let loaded: Addon | null = null;

/** @throws {Error} if the addon is not built, with how to build it */
export function loadAddon(): Addon {
  try {
    loaded ??= createRequire(import.meta.url)(ADDON_FILE) as Addon;
    return loaded;
  } catch (error) {
    throw new Error(`the addon for GPIO cannot be loaded: ${BUILD_REMEDY}`, { cause: error });
  }
}
