export type { Ros1Options } from './graph.ts';
export { openRos1Graph } from './graph.ts';
