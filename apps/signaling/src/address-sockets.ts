import type { Server } from 'node:net';
import { addressKey, plainAddress } from '@farpoint/service';

/**
 * Limits the open TCP connections from one address to a port, before anything is read from them. Without it, one address
 * could fill the port with connections that never say anything: what {@link Admission} counts are WebSockets.
 *
 * @param exempt whether an address is a proxy's, from which all come
 * @param onRefused called for each connection that is closed at once
 */
export function limitSocketsPerAddress(
  server: Server,
  mostPerAddress: number,
  exempt: (address: string) => boolean,
  onRefused: (address: string) => void,
): void {
  const open = new Map<string, number>();
  server.prependListener('connection', (socket) => {
    const address = plainAddress(socket.remoteAddress ?? 'unknown');
    if (exempt(address)) return;
    const key = addressKey(address);
    const here = open.get(key) ?? 0;
    if (here >= mostPerAddress) {
      socket.destroy();
      onRefused(address);
      return;
    }
    open.set(key, here + 1);
    socket.once('close', () => {
      const left = (open.get(key) ?? 1) - 1;
      if (left === 0) open.delete(key);
      else open.set(key, left);
    });
  });
}
