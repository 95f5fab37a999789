export { openRos1Graph, type Ros1Options, ros1Hostname } from './graph.ts';
