export { callService, type ServiceCall } from './call-service.ts';
export { openRos1Graph } from './graph.ts';
export type { Ros1Options } from './options.ts';
export {
  readServiceReply,
  SERVICE_TYPES,
  type ServiceReply,
  type ServiceType,
} from './service-types.ts';
export { connectionHeader, readConnectionHeader, readServiceAnswer } from './service-wire.ts';
