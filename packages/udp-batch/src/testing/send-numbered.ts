/** Sends as many numbered datagrams of one size in one turn, and prints what became of them: PORT COUNT BYTES. */
import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import { loadAddon } from '../addon.ts';
import { DatagramBatch } from '../datagram-batch.ts';

const [port, count, bytes] = process.argv.slice(2).map(Number) as [number, number, number];
const socket = createSocket('udp4').bind(0, '127.0.0.1');
await once(socket, 'listening');
const counters = { batched: 0, single: 0, failed: 0 };
const batch = new DatagramBatch(socket, loadAddon(), counters);
for (let n = 0; n < count; n++) {
  const datagram = Buffer.alloc(bytes, n);
  batch.send([datagram.subarray(0, 12), datagram.subarray(12)], port, '127.0.0.1');
}
// After the turn's end, at which the batch leaves.
await new Promise((resolve) => setImmediate(resolve));
await new Promise((resolve) => socket.send('end', port, '127.0.0.1', resolve));
socket.close();
console.log(JSON.stringify(counters));
