export { openRos1Graph, type Ros1Options } from './graph.ts';
