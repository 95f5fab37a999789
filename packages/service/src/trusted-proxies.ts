import { BlockList, isIP } from 'node:net';
import * as z from 'zod';
import { list } from './option-schemas.ts';
import { plainAddress } from './peer-address.ts';

/** Words for networks that an option names often. */
const NETWORKS: Readonly<Record<string, readonly string[]>> = {
  loopback: ['127.0.0.0/8', '::1/128'],
  private: ['10.0.0.0/8', '172.16.0.0/12', '192.168.0.0/16', 'fc00::/7', 'fe80::/10'],
};

/** For an option: addresses, networks such as 10.0.0.0/8, and the words above. */
export function proxies(): z.ZodType<string[]> {
  const message = 'must be a list of addresses and networks such as 10.0.0.0/8, or loopback, or private';
  return list(
    z.string(message).refine((text) => NETWORKS[text] !== undefined || readNetwork(text) !== null, message),
  );
}

/** The proxies whose word about addresses is taken. */
export class TrustedProxies {
  readonly #networks = new BlockList();

  /** @param networks as {@link proxies} takes them */
  constructor(networks: readonly string[]) {
    for (const text of networks.flatMap((each) => NETWORKS[each] ?? [each])) {
      const network = readNetwork(text);
      if (network === null) throw new RangeError(`${text} is no address or network`);
      this.#networks.addSubnet(network.address, network.bits, network.family);
    }
  }

  /** @param address as {@link plainAddress} writes it */
  has(address: string): boolean {
    const family = isIP(address);
    return family !== 0 && this.#networks.check(address, family === 4 ? 'ipv4' : 'ipv6');
  }
}

function readNetwork(text: string): { address: string; bits: number; family: 'ipv4' | 'ipv6' } | null {
  const [, written = '', digits] = /^([0-9a-f.:]+)(?:\/(\d{1,3}))?$/i.exec(text) ?? [];
  const address = plainAddress(written);
  const most = isIP(address) === 4 ? 32 : isIP(address) === 6 ? 128 : 0;
  const bits = digits === undefined ? most : Number(digits);
  if (most === 0 || bits > most) return null;
  return { address, bits, family: most === 32 ? 'ipv4' : 'ipv6' };
}
