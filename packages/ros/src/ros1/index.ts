export { openRos1Graph } from './graph.ts';
export type { Ros1Options } from './options.ts';
