import { createServer } from 'node:net';
import { reserveNumber } from './reserved-numbers.ts';

/**
 * Below those that the system assigns to outgoing connections, which would take one before its program listens, and above
 * those of Janus and of programs that people start.
 */
const PORTS = { kind: 'port', first: 24_000, last: 31_999 };

/** TCP ports that nothing listens on and that no other test of this machine is given before this process ends. */
export async function freePorts(count: number): Promise<number[]> {
  const ports: number[] = [];
  while (ports.length < count) ports.push(await reserveNumber(PORTS, isPortFree));
  return ports;
}

/** Whether nothing listens on the port at either loopback address. */
export async function isPortFree(port: number): Promise<boolean> {
  // Development servers listen on the address of `localhost`, which may be ::1 alone.
  const codes = await Promise.all(['127.0.0.1', '::1'].map((host) => tryListen(port, host)));
  return !codes.some((code) => code === 'EADDRINUSE' || code === 'EACCES');
}

/** @returns why not, or `null` */
function tryListen(port: number, host: string): Promise<string | null> {
  return new Promise((resolve) => {
    const server = createServer();
    server.once('error', (error: NodeJS.ErrnoException) => resolve(error.code ?? ''));
    server.listen(port, host, () => server.close(() => resolve(null)));
  });
}
