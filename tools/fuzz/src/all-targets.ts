import type { FuzzTarget } from './fuzz-target.ts';
import { cloudTargets } from './targets/clouds.ts';
import { fileTargets } from './targets/files.ts';
import { mediaTargets } from './targets/media.ts';
import { messageTargets } from './targets/messages.ts';
import { processTargets } from './targets/processes.ts';
import { rosTargets } from './targets/ros.ts';
import { transportTargets } from './targets/transport.ts';

export const allTargets: readonly FuzzTarget[] = [
  ...transportTargets,
  ...mediaTargets,
  ...messageTargets,
  ...cloudTargets,
  ...rosTargets,
  ...processTargets,
  ...fileTargets,
];
