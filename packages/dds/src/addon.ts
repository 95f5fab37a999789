/** The native addon: what it offers, and loading it. */
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
 * Errors carry `code`: `CLOSED`; `RANGE`: a mistake of the caller; `MEMORY`; `CONFIGURATION`: the domain runs with another
 * one in this process; `DDS`: what CycloneDDS says. Names are those of DDS.
 */
export interface Addon {
  /** @param onDiscovery called when publishers or subscribers have come or gone */
  open(domain: number, configuration: string, onDiscovery: () => void): GraphHandle;
  /** What CycloneDDS said last, in this process; empty where nothing since the last call. */
  lastLog(): string;
  closeGraph(graph: GraphHandle): void;
  /** Endpoints of other participants, four values each: topic, type, reliable, transient-local. */
  others(graph: GraphHandle, publishers: boolean): (string | boolean)[];
  /** @param onMessages called when messages wait, once until {@link rest} */
  subscribe(
    graph: GraphHandle,
    topic: string,
    type: string,
    reliable: boolean,
    transientLocal: boolean,
    depth: number,
    queue: number,
    onMessages: () => void,
  ): ReaderHandle;
  closeReader(reader: ReaderHandle): void;
  /** How many messages wait; for later ones `onMessages` is called again. */
  rest(reader: ReaderHandle): number;
  /**
   * Copies the oldest message out: its size, -1 where there is none. One that is larger than `to` stays.
   * @param receivedMs gets when it was whole, CLOCK_MONOTONIC
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
  ): WriterHandle;
  closeWriter(writer: WriterHandle): void;
  /** Whether it was taken; not where a reliable subscriber confirms too slowly. Never waits. */
  write(writer: WriterHandle, bytes: Uint8Array): boolean;
  subscribers(writer: WriterHandle): number;
}

/** How the addon's calls take a QoS: reliable, transient-local, depth. */
export function qosArguments({ reliability, durability, depth }: Qos): [boolean, boolean, number] {
  return [reliability === 'reliable', durability === 'transient-local', depth];
}

let loaded: Addon | null = null;

/** @throws {RosFault} `unavailable`, with what to do about it */
export function loadAddon(): Addon {
  loaded ??= requireAddon(ADDON_FILE);
  return loaded;
}

/** The same, of a file. */
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

/** Whether DDS can be used here. */
export function isAvailable(): boolean {
  try {
    loadAddon();
    return true;
  } catch {
    return false;
  }
}
