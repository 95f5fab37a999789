import type { RTCPeerConnection } from 'werift';

/** The addresses of the host candidates that a fresh connection offers. */
export async function hostAddressesOffered(connection: RTCPeerConnection): Promise<string[]> {
  connection.createDataChannel('x');
  await connection.setLocalDescription(await connection.createOffer());
  const sdp = connection.localDescription?.sdp ?? '';
  return [...sdp.matchAll(/^a=candidate:\S+ 1 udp \d+ (\S+) \d+ typ host/gm)].map(
    ([, address = '']) => address,
  );
}
