import type { Server } from 'node:net';

/** Resolves once a server listens. @throws {Error} if it cannot, for example EADDRINUSE */
export function listen(server: Server, address: { host: string; port: number }): Promise<void> {
  return new Promise((resolve, reject) => {
    server.once('error', reject);
    server.listen(address.port, address.host, () => {
      server.off('error', reject);
      resolve();
    });
  });
}
