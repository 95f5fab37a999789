/** Sends datagrams at a rate from a socket of its own until it is told to stop: a thread, so that it delays nobody. */
import { createSocket } from 'node:dgram';
import { isIPv6 } from 'node:net';
import { parentPort, workerData } from 'node:worker_threads';

export interface FloodOrder {
  host: string;
  port: number;
  perSecond: number;
  /** Sent in turn. */
  datagrams: readonly Uint8Array[];
}

const SEND_EVERY_MS = 2;

if (parentPort !== null) {
  const { host, port, perSecond, datagrams } = workerData as FloodOrder;
  const socket = createSocket(isIPv6(host) ? 'udp6' : 'udp4');
  socket.connect(port, host);
  socket.on('error', () => undefined);
  let sent = 0;
  socket.once('connect', () => {
    const begun = performance.now();
    const timer = setInterval(() => {
      const due = ((performance.now() - begun) / 1000) * perSecond;
      while (sent < due) socket.send(datagrams[sent++ % datagrams.length] as Uint8Array);
    }, SEND_EVERY_MS);
    parentPort?.once('message', () => {
      clearInterval(timer);
      parentPort?.postMessage(sent / ((performance.now() - begun) / 1000));
      socket.close();
    });
  });
}
