import { BlockList, isIP } from 'node:net';
import { isLocalName, LOCAL_NETWORKS } from './local-names.ts';

/** An address of this machine by which others of a local network reach it. */
export interface LocalAddress {
  readonly address: string;
  /** Name of the network interface, such as `wlan0`. */
  readonly name: string;
}

/** As `os.networkInterfaces()` lists them. */
export type NetworkInterfaces = Readonly<
  Record<string, readonly { readonly address: string; readonly internal: boolean }[] | undefined>
>;

const local = new BlockList();
for (const network of LOCAL_NETWORKS) {
  const [address, prefix] = network.split('/') as [string, string];
  local.addSubnet(address, Number(prefix), isIP(address) === 6 ? 'ipv6' : 'ipv4');
}

/** Whether an address is one of a local network. */
export function isLocalAddress(address: string): boolean {
  const version = isIP(address);
  return version !== 0 && local.check(address, version === 6 ? 'ipv6' : 'ipv4');
}

/** @param host an address, or a DNS name in lower case */
export function isLocalHost(host: string): boolean {
  return isIP(host) === 0 ? isLocalName(host) : isLocalAddress(host);
}

/** Bridges and tunnels of containers and virtual machines, which a headset does not reach. */
const VIRTUAL = /^(docker|br-|veth|virbr|vmnet|vboxnet|cni|flannel|podman|lxc)/;

/**
 * The addresses of this machine that others on the local network use, the likeliest first: those of real interfaces
 * before virtual ones. IPv4 only: people read and type them.
 */
export function localAddresses(interfaces: NetworkInterfaces): LocalAddress[] {
  const found: LocalAddress[] = [];
  for (const [name, addresses = []] of Object.entries(interfaces)) {
    for (const { address, internal } of addresses) {
      if (!internal && isIP(address) === 4 && isLocalAddress(address)) found.push({ address, name });
    }
  }
  return found.toSorted((a, b) => Number(VIRTUAL.test(a.name)) - Number(VIRTUAL.test(b.name)));
}
