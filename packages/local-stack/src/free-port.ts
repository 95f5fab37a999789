import { createServer } from 'node:net';

/** TCP ports that are free on loopback now; held together while choosing, so that they differ. */
export async function freePorts(count: number): Promise<number[]> {
  const servers = await Promise.all(
    Array.from({ length: count }, async () => {
      const server = createServer();
      await new Promise<void>((resolve, reject) => {
        server.once('error', reject);
        server.listen(0, '127.0.0.1', resolve);
      });
      return server;
    }),
  );
  const ports = servers.map((server) => (server.address() as { port: number }).port);
  await Promise.all(servers.map((server) => new Promise((resolve) => server.close(resolve))));
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
