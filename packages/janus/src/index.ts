export * from './janus-failure.ts';
export type { JanusCandidate, Jsep } from './janus-message.ts';
export * from './streaming-client.ts';
export type {
  CreatedMountpoint,
  MountpointInfo,
  MountpointMedia,
  MountpointRequest,
  StreamingEvent,
} from './streaming-message.ts';
