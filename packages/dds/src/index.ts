export { isAvailable } from './addon.ts';
export {
  type DdsOptions,
  interfaceSchema,
  MOST_DOMAIN,
  MOST_MESSAGE_BYTES,
  machineSchema,
} from './configuration.ts';
export { DdsGraph, type DdsGraphOptions } from './dds-graph.ts';
