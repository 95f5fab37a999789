/** Which of this machine's addresses a peer is offered as host candidates. */
import type { NetworkInterfaceInfo } from 'node:os';

export interface HostAddress {
  address: string;
  /** Of the network interface. */
  name: string;
}

/** As `os.networkInterfaces()` gives them. */
export type Interfaces = Readonly<
  Record<string, readonly Pick<NetworkInterfaceInfo, 'address' | 'family' | 'internal'>[] | undefined>
>;

/** Each address has a socket, and a pair with each candidate of the peer. */
const MAX_ADDRESSES = 16;
/** An interface may have a dozen temporary IPv6 addresses. They must not displace another interface. */
const MAX_PER_INTERFACE = 4;

/**
 * VPNs and other tunnels. Often they are the only way to a robot behind a mobile network. They come after the networks
 * that they run on, because a tunnel is a detour between peers of one network.
 */
const TUNNEL = /^(?:utun|tun|tap|ipsec|wg|tailscale|zt|feth|ppp|gre|vti|sit|nebula|nordlynx|proton|mullvad)/i;

/**
 * The host's own ends of the networks of its containers and virtual machines. All of these guests reach the host's
 * other addresses too, and nobody else reaches these, which moreover are the same on many machines. `veth` is not among
 * them: on a host, such an end is part of a bridge and has no address of its own; where it has one, as in a network
 * namespace, it is a cable like any other. Nor are `br0` and `br-lan`, which are a machine's connection to its network.
 */
const GUEST_BRIDGE =
  /^(?:docker\d|docker_gwbridge|br-[0-9a-f]{12}$|podman|cni|flannel|cali|lxcbr|lxdbr|virbr|vmnet|vboxnet)/;

/**
 * First the addresses of ordinary networks, then those of tunnels. Where there is none of either, those that are not
 * shared with the rest of the world: link-local ones, for two machines on one cable, and those of guests' bridges.
 *
 * IPv6 link-local addresses are left out, because a candidate cannot say which interface they belong to.
 */
export function hostAddresses(interfaces: Interfaces): HostAddress[] {
  const ranked: [HostAddress[], HostAddress[], HostAddress[], HostAddress[]] = [[], [], [], []];
  for (const name of Object.keys(interfaces).sort()) {
    const usable = (interfaces[name] ?? [])
      .filter(({ internal, family, address }) => !internal && !(family === 'IPv6' && isLinkLocal(address)))
      .sort((one, other) => one.family.localeCompare(other.family))
      .slice(0, MAX_PER_INTERFACE);
    for (const { address } of usable) {
      const rank = isLinkLocal(address) ? 2 : GUEST_BRIDGE.test(name) ? 3 : TUNNEL.test(name) ? 1 : 0;
      ranked[rank].push({ address, name });
    }
  }
  const [ordinary, tunnels, cables, bridges] = ranked;
  const reachable = [...ordinary, ...tunnels];
  return (reachable.length > 0 ? reachable : [...cables, ...bridges]).slice(0, MAX_ADDRESSES);
}

/** 169.254.0.0/16 (RFC 3927), or fe80::/10 (RFC 4291). */
function isLinkLocal(address: string): boolean {
  return address.startsWith('169.254.') || /^fe[89ab][0-9a-f]:/i.test(address);
}
