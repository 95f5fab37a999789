import { expect, it, vi } from 'vitest';
import { createReferencePeerConnection } from './peer-connection.ts';

vi.mock('node:os', async (original) => ({
  ...(await original<typeof import('node:os')>()),
  networkInterfaces: () => ({ tun0: [{ address: '127.0.0.8', family: 'IPv4', internal: false }] }),
}));

it('offers the peer the address of a VPN', async () => {
  const connection = createReferencePeerConnection();
  try {
    connection.createDataChannel('x');
    await connection.setLocalDescription(await connection.createOffer());
    expect(connection.localDescription?.sdp).toMatch(/^a=candidate:\S+ 1 udp \d+ 127\.0\.0\.8 \d+ typ host/m);
  } finally {
    await connection.close();
  }
});
