export { isAvailable } from './addon.ts';
export { type DdsOptions, MOST_MESSAGE_BYTES } from './configuration.ts';
export { DdsGraph, type DdsGraphOptions } from './dds-graph.ts';
