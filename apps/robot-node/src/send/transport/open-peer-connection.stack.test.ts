import { hostAddressesOffered } from '@farpoint/webrtc/testing';
import { expect, it, vi } from 'vitest';
import { openPeerConnection } from './open-peer-connection.ts';

vi.mock('node:os', async (original) => ({
  ...(await original<typeof import('node:os')>()),
  networkInterfaces: () => ({ tun0: [{ address: '127.0.0.8', family: 'IPv4', internal: false }] }),
}));

it('offers operators the address of a VPN', async () => {
  const connection = openPeerConnection({ iceServers: [] });
  try {
    expect(await hostAddressesOffered(connection)).toContain('127.0.0.8');
  } finally {
    await connection.close();
  }
});
