import type { FrameSource } from './frame-source.ts';
import { SimSource } from './sim-source.ts';

/** Which source to open; plain data, so that it can be handed to the worker. */
export type SourceOptions = { kind: 'sim'; seed: number; size: number };

/** @throws {Error} naming what could not be opened and why */
export async function openSource(options: SourceOptions): Promise<FrameSource> {
  switch (options.kind) {
    case 'sim':
      return SimSource.create(options);
  }
}
