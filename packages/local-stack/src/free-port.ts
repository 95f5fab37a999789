import { createServer } from 'node:net';

/**
 * Below the ports that systems give to connections by themselves (Linux: from 32768): one of those could be taken by a
 * connection before the program listens.
 */
const PORTS = { first: 20_000, count: 12_000 } as const;
/** Processes that look for ports at the same time begin so far from each other. */
const APART = 97;

/** A program takes some time until it listens at its port. Nobody else is given it meanwhile, or ever. */
const given = new Set<number>();
let next = (process.pid * APART) % PORTS.count;

/**
 * TCP ports that are free on loopback now, and that this process has not been given before.
 *
 * @throws {Error} if there are none
 */
export async function freePorts(count: number): Promise<number[]> {
  const ports: number[] = [];
  for (let tries = 0; ports.length < count; tries++) {
    if (tries === PORTS.count) throw new Error(`no ${count} of the ports from ${PORTS.first} on are free`);
    const port = PORTS.first + next;
    next = (next + 1) % PORTS.count;
    // Taken at once: others may be looking while this one is tried.
    if (given.has(port)) continue;
    given.add(port);
    if (await isPortFree(port)) ports.push(port);
  }
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
