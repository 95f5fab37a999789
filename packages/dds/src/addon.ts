/** Interface of the native addon, and loading it. */
import { createRequire } from 'node:module';
import { type Qos, RosFault } from '@farpoint/ros';
import { ADDON_FILE, BUILD_REMEDY } from './build.ts';

declare const handle: unique symbol;
export interface GraphHandle {
  readonly [handle]: 'graph';
}
export interface ReaderHandle {
  readonly [handle]: 'reader';
}
export interface WriterHandle {
  readonly [handle]: 'writer';
}

/**
 * Errors carry `code`: `CLOSED`; `RANGE`: a mistake of the caller; `MEMORY`; `CONFIGURATION`: this process already uses
 * the domain with a different configuration; `DDS`: an error of CycloneDDS. Names are DDS names.
 */
export interface Addon {
  /** @param onDiscovery called when publishers or subscribers have appeared or disappeared */
  open(domain: number, configuration: string, onDiscovery: () => void): GraphHandle;
  /** The last message that CycloneDDS logged in this process; empty if none since the last call. */
  lastLog(): string;
  closeGraph(graph: GraphHandle): void;
  /** Endpoints of other participants, four values each: topic, type, reliable, transient-local. */
  others(graph: GraphHandle, publishers: boolean): (string | boolean)[];
  /**
   * @param userData told to all that match; may be empty
   * @param onMessages called when messages wait, then not again until {@link rest}
   */
  subscribe(
    graph: GraphHandle,
    topic: string,
    type: string,
    reliable: boolean,
    transientLocal: boolean,
    depth: number,
    userData: string,
    queue: number,
    onMessages: () => void,
  ): ReaderHandle;
  closeReader(reader: ReaderHandle): void;
  /** Returns how many messages wait; `onMessages` is called again for later ones. */
  rest(reader: ReaderHandle): number;
  /**
   * Copies the oldest message into `to` and returns its size, or -1 if there is none. A message larger than `to` stays.
   *
   * @param receivedMs gets the time when the message was complete, CLOCK_MONOTONIC
   */
  take(reader: ReaderHandle, to: Uint8Array, receivedMs: Float64Array): number;
  /** @param to gets received, dropped, lost, publishers */
  readerCounts(reader: ReaderHandle, to: Float64Array): void;
  advertise(
    graph: GraphHandle,
    topic: string,
    type: string,
    reliable: boolean,
    transientLocal: boolean,
    depth: number,
    userData: string,
  ): WriterHandle;
  closeWriter(writer: WriterHandle): void;
  /** Returns whether DDS accepted the message: not if a reliable subscriber acknowledges too slowly. Never blocks. */
  write(writer: WriterHandle, bytes: Uint8Array): boolean;
  subscribers(writer: WriterHandle): number;
  /** Readers that are matched with it now, two values each: GUID in hexadecimal digits, user data. */
  matchedReaders(writer: WriterHandle): string[];
  /** The same of writers. */
  matchedWriters(reader: ReaderHandle): string[];
}

/** Converts a QoS to the arguments of the addon's calls: reliable, transient-local, depth. */
export function qosArguments({ reliability, durability, depth }: Qos): [boolean, boolean, number] {
  return [reliability === 'reliable', durability === 'transient-local', depth];
}

let loaded: Addon | null = null;

/** @throws {RosFault} `unavailable`, with what to do about it */
export function loadAddon(): Addon {
  loaded ??= requireAddon(ADDON_FILE);
  return loaded;
}

/** Loads the addon from a given file. */
export function requireAddon(file: string): Addon {
  try {
    return createRequire(import.meta.url)(file) as Addon;
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'MODULE_NOT_FOUND')
      throw new RosFault('unavailable', 'the DDS addon is not built', { remedy: BUILD_REMEDY });
    const what = `the DDS addon cannot be loaded (${error instanceof Error ? error.message : String(error)})`;
    throw new RosFault('unavailable', what, { remedy: BUILD_REMEDY, cause: error });
  }
}

/** Whether DDS can be used on this machine. */
export function isAvailable(): boolean {
  try {
    loadAddon();
    return true;
  } catch {
    return false;
  }
}
