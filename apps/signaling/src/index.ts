export { defaultOptions, type SignalingOptions } from './options.ts';
export { type RunningSignaling, type SignalingRim, startSignaling } from './server.ts';
export type { SignalingPorts } from './service-ports.ts';
