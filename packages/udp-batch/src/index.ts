export { type Addon, loadAddon } from './addon.ts';
export { DatagramBatch, type SendCounters } from './datagram-batch.ts';
