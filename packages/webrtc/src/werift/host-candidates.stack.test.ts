import { describe, expect, it } from 'vitest';
import { RTCPeerConnection } from 'werift';
import type { Interfaces } from '../ice/host-addresses.ts';
import { useCleanups } from '../testing/cleanups.ts';
import { chooseHostCandidates } from './host-candidates.ts';
import { discardSockets } from './ice-restart.ts';
import { WeriftShapeError } from './werift-shape.ts';

const cleanups = useCleanups();

const address = (text: string) => ({ address: text, family: 'IPv4', internal: false }) as const;

function peer(interfaces: () => Interfaces): RTCPeerConnection {
  const connection = new RTCPeerConnection({ iceServers: [], iceUseTcp: false, bundlePolicy: 'max-bundle' });
  cleanups.push(() => connection.close());
  chooseHostCandidates(connection, interfaces);
  return connection;
}

/** Host candidates in the description, those of the highest priority first. */
function offered(connection: RTCPeerConnection): { address: string; priority: number }[] {
  return [
    ...(connection.localDescription?.sdp ?? '').matchAll(/candidate:\S+ 1 udp (\d+) (\S+) \d+ typ host/gi),
  ]
    .map(([, priority, host]) => ({ address: host ?? '', priority: Number(priority) }))
    .sort((one, other) => other.priority - one.priority);
}

async function offer(connection: RTCPeerConnection): Promise<string> {
  await connection.setLocalDescription(await connection.createOffer());
  return connection.localDescription?.sdp ?? '';
}

// The loopback network stands for the interfaces: only there can a test bind every address.
describe('host candidates', () => {
  it.each(['tun0', 'utun3', 'ipsec0', 'tap0', 'wg0', 'tailscale0', 'veth7'])(
    'are offered on %s, and lead to a connection',
    async (name) => {
      const robot = peer(() => ({ [name]: [address('127.0.0.8')] }));
      const operator = peer(() => ({ [name]: [address('127.0.0.9')] }));
      robot.createDataChannel('x');
      const connected = new Promise<void>((resolve) => {
        robot.connectionStateChange.subscribe((state) => state === 'connected' && resolve());
      });
      await operator.setRemoteDescription({ type: 'offer', sdp: await offer(robot) });
      await operator.setLocalDescription(await operator.createAnswer());
      await robot.setRemoteDescription({ type: 'answer', sdp: operator.localDescription?.sdp ?? '' });
      expect(offered(robot).map((one) => one.address)).toEqual(['127.0.0.8']);
      await connected;
    },
  );

  it('have priorities of their own: ordinary networks before tunnels', async () => {
    const robot = peer(() => ({ tun0: [address('127.0.0.8')], wlan0: [address('127.0.0.2')] }));
    robot.createDataChannel('x');
    await offer(robot);
    expect(offered(robot)).toEqual([
      { address: '127.0.0.2', priority: 2130706431 },
      { address: '127.0.0.8', priority: 2130706175 },
    ]);
  });

  it('are those of the present networks after a restart', async () => {
    let interfaces: Interfaces = { wlan0: [address('127.0.0.2')] };
    const robot = peer(() => interfaces);
    robot.createDataChannel('x');
    await offer(robot);
    interfaces = { tun0: [address('127.0.0.8')] };
    robot.restartIce();
    const renewed = await robot.createOffer();
    for (const transport of robot.dtlsTransports) discardSockets(transport);
    await robot.setLocalDescription(renewed);
    expect(offered(robot).map((one) => one.address)).toEqual(['127.0.0.8']);
  });

  it('are the machine’s own by default, and never its loopback', async () => {
    const robot = new RTCPeerConnection({ iceServers: [], iceUseTcp: false });
    cleanups.push(() => robot.close());
    chooseHostCandidates(robot);
    robot.createDataChannel('x');
    await offer(robot);
    expect(offered(robot).map((one) => one.address)).not.toContain('127.0.0.1');
    expect(() => chooseHostCandidates(robot)).toThrow(WeriftShapeError);
  });
});
