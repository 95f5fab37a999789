import { parseArgs } from 'node:util';

export interface ProcessArguments {
  layout: 'reference' | 'farpoint';
  folder: string;
  /** Per frame. */
  points: number;
  /** 0 for as fast as possible. */
  fps: number;
  /** A file for the results; see the process. */
  log: string;
}

/** Parses the arguments of this folder's processes. */
export function readArguments(): ProcessArguments {
  const { values } = parseArgs({
    options: {
      layout: { type: 'string', default: 'farpoint' },
      folder: { type: 'string', default: '/dev/shm' },
      points: { type: 'string', default: '230400' },
      fps: { type: 'string', default: '0' },
      log: { type: 'string', default: '' },
    },
  });
  const { layout, folder, log } = values;
  if (layout !== 'reference' && layout !== 'farpoint') throw new Error(`--layout ${layout} is unknown`);
  return { layout, folder, log, points: Number(values.points), fps: Number(values.fps) };
}
