/** The UDP sockets of a werift connection, which werift does not expose. */
import type { RTCPeerConnection } from 'werift';

interface UdpSocketShape {
  on(event: 'error', listener: () => void): unknown;
  setRecvBufferSize(bytes: number): void;
}

interface IceShape {
  protocols?: { transport?: { socket?: Partial<UdpSocketShape> } }[];
  lookup?: { mdnsInstance?: { on?: UdpSocketShape['on'] } };
}

/** The same as in a browser; the system may grant less. A frame of 100,000 points is 0.8 MB. */
const RECEIVE_BUFFER_BYTES = 2 * 1024 * 1024;

const prepared = new WeakSet<object>();

/**
 * Gives each socket a buffer for bursts and an error listener: without one, a network that goes away would end the
 * process. Call it whenever there may be new sockets.
 */
export function prepareSockets(connection: RTCPeerConnection): void {
  for (const transport of connection.iceTransports) {
    const { protocols = [] } = transport.connection as unknown as IceShape;
    for (const { transport: udp } of protocols) guardSocket(udp?.socket);
  }
}

/** Prepares one socket when it comes into use. Does nothing for other values or a socket that is already prepared. */
export function guardSocket(candidate: unknown): void {
  const socket = candidate as Partial<UdpSocketShape> | undefined;
  if (socket === undefined || typeof socket.on !== 'function' || prepared.has(socket)) return;
  prepared.add(socket);
  socket.on('error', () => undefined);
  try {
    socket.setRecvBufferSize?.(RECEIVE_BUFFER_BYTES);
  } catch {
    // Not bound yet, or TCP: it works without.
  }
}

/**
 * Gives the mDNS look-ups an error listener: without one, the process would end if another program uses port 5353
 * exclusively. Call it in the same turn as `addIceCandidate`.
 */
export function guardLookups(connection: RTCPeerConnection): void {
  for (const transport of connection.iceTransports) {
    const mdns = (transport.connection as unknown as IceShape).lookup?.mdnsInstance;
    if (mdns === undefined || typeof mdns.on !== 'function' || prepared.has(mdns)) continue;
    prepared.add(mdns);
    // The name stays unresolved.
    mdns.on('error', () => undefined);
  }
}
