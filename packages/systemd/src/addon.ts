import { createRequire } from 'node:module';
import { ADDON_FILE, BUILD_REMEDY } from './build.ts';

/** Sends one datagram to a Unix socket; returns 0, or an errno. */
export type Send = (socket: string, message: string) => number;

/** @throws {Error} if the addon is not built, with how to build it */
export function loadSend(): Send {
  try {
    return (createRequire(import.meta.url)(ADDON_FILE) as { notify: Send }).notify;
  } catch (error) {
    throw new Error(`the addon for systemd cannot be loaded: ${BUILD_REMEDY}`, { cause: error });
  }
}
