export { chooseRos2Graph, findRclnodejs, isSourced, type Ros2Graph } from './environment.ts';
export { RclnodejsGraph, type RclnodejsGraphOptions } from './rclnodejs-graph.ts';
