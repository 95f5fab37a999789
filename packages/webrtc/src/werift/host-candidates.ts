import { networkInterfaces } from 'node:os';
import type { RTCDtlsTransport, RTCPeerConnection } from 'werift';
import { hostAddresses, type Interfaces } from '../ice/host-addresses.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

interface IceShape {
  options: { useIpv4: boolean; useIpv6: boolean; additionalHostAddresses?: string[] | undefined };
  gatherCandidates(): Promise<void>;
  pairLocalProtocol(protocol: ProtocolShape): void;
}

interface ProtocolShape {
  localCandidate?: { type: string; host: string; priority: number };
}

/** RFC 8445 §5.1.2.1. */
const HOST_PREFERENCE = 126;
const MAX_LOCAL_PREFERENCE = 65_535;

/**
 * Replaces werift's choice of host candidates, which leaves out every VPN, by ours. The interfaces are read anew each time
 * that candidates are gathered: a robot changes networks. Call it before the connection has any transceiver or channel.
 *
 * @throws {WeriftShapeError}
 */
export function chooseHostCandidates(
  connection: RTCPeerConnection,
  interfaces: () => Interfaces = networkInterfaces,
): void {
  if (connection.dtlsTransports.length > 0) throw new WeriftShapeError('host candidates chosen too late');
  const shape = connection as unknown as { createDtlsTransport(options?: unknown): RTCDtlsTransport };
  expectMethods(shape, 'the connection', ['createDtlsTransport']);
  const createDtls = shape.createDtlsTransport.bind(connection);
  shape.createDtlsTransport = (options) => {
    const transport = createDtls(options);
    chooseFor(transport.iceTransport.connection as unknown as IceShape, interfaces);
    return transport;
  };
}

function chooseFor(ice: IceShape, interfaces: () => Interfaces): void {
  expectMethods(ice, 'the ICE connection', ['gatherCandidates', 'pairLocalProtocol']);
  if (typeof ice.options?.useIpv4 !== 'boolean' || typeof ice.options.useIpv6 !== 'boolean')
    throw new WeriftShapeError('no ICE options');
  let chosen: string[] = [];
  const gather = ice.gatherCandidates.bind(ice);
  ice.gatherCandidates = () => {
    chosen = hostAddresses(interfaces()).map(({ address }) => address);
    ice.options.useIpv4 = false;
    ice.options.useIpv6 = false;
    ice.options.additionalHostAddresses = chosen;
    return gather();
  };
  const pair = ice.pairLocalProtocol.bind(ice);
  ice.pairLocalProtocol = (protocol) => {
    const { localCandidate } = protocol;
    const place = localCandidate?.type === 'host' ? chosen.indexOf(localCandidate.host) : -1;
    // werift gives all the same priority. With ours, both peers check ordinary networks before tunnels.
    if (localCandidate !== undefined && place >= 0) localCandidate.priority = hostPriority(place);
    pair(protocol);
  };
}

function hostPriority(place: number): number {
  return HOST_PREFERENCE * 2 ** 24 + (MAX_LOCAL_PREFERENCE - place) * 2 ** 8 + 255;
}
