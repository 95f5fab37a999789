export { callService, type ServiceCall } from './call-service.ts';
export { openRos1Graph, type Ros1Options } from './graph.ts';
