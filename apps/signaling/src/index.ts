export { defaultOptions, type SignalingOptions } from './options.ts';
export { type RunningSignaling, type SignalingPorts, type SignalingRim, startSignaling } from './server.ts';
