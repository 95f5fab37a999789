import type { Socket } from 'node:dgram';
import { DatagramBatch, loadAddon, type SendCounters } from '@farpoint/udp-batch';

/** Datagrams of all sockets of this process. */
export const datagramsSent: SendCounters = { batched: 0, single: 0, failed: 0 };

const batches = new WeakMap<Socket, DatagramBatch>();

/** What all streams on a socket send with, so that what they send in one turn leaves together. */
export function batchOf(socket: Socket): DatagramBatch {
  let batch = batches.get(socket);
  if (batch === undefined) {
    batch = new DatagramBatch(socket, loadAddon(), datagramsSent);
    batches.set(socket, batch);
  }
  return batch;
}
