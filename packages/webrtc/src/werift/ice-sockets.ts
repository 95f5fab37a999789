/** The UDP sockets below a werift connection, which it keeps to itself. */
import type { RTCPeerConnection } from 'werift';

interface UdpSocketShape {
  on(event: 'error', listener: () => void): unknown;
  setRecvBufferSize(bytes: number): void;
}

interface IceShape {
  protocols?: { transport?: { socket?: Partial<UdpSocketShape> } }[];
  lookup?: { mdnsInstance?: { on?: UdpSocketShape['on'] } };
}

/** As a browser has it; the system may give less. A frame of 100,000 points is 0.8 MB. */
const RECEIVE_BUFFER_BYTES = 2 * 1024 * 1024;

const prepared = new WeakSet<object>();

/**
 * Gives each socket room for bursts, and a listener for errors: without one a network that goes away would end the
 * process. Call it whenever there may be new ones.
 */
export function prepareSockets(connection: RTCPeerConnection): void {
  for (const transport of connection.iceTransports) {
    const { protocols = [] } = transport.connection as unknown as IceShape;
    for (const { transport: udp } of protocols) guardSocket(udp?.socket);
  }
}

/** One of them, as it comes into use. Does nothing for what is no socket, or is prepared. */
export function guardSocket(candidate: unknown): void {
  const socket = candidate as Partial<UdpSocketShape> | undefined;
  if (socket === undefined || typeof socket.on !== 'function' || prepared.has(socket)) return;
  prepared.add(socket);
  socket.on('error', () => undefined);
  try {
    socket.setRecvBufferSize?.(RECEIVE_BUFFER_BYTES);
  } catch {
    // Not bound yet, or TCP: it does without.
  }
}

/**
 * Gives the mDNS look-ups a listener for errors: without one a port 5353 that another program keeps to itself would end the
 * process. Call it in the same turn as `addIceCandidate`.
 */
export function guardLookups(connection: RTCPeerConnection): void {
  for (const transport of connection.iceTransports) {
    const mdns = (transport.connection as unknown as IceShape).lookup?.mdnsInstance;
    if (mdns === undefined || typeof mdns.on !== 'function' || prepared.has(mdns)) continue;
    prepared.add(mdns);
    // The name stays unknown.
    mdns.on('error', () => undefined);
  }
}
