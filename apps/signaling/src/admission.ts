import type { IncomingMessage } from 'node:http';
import { isIPv4 } from 'node:net';
import type { RejectReason } from './observer.ts';

export interface AdmissionLimits {
  readonly maxConnections: number;
  readonly maxConnectionsPerAddress: number;
}

/** Counts connections in total and by address, and limits them. */
export class Admission {
  readonly #limits: AdmissionLimits;
  readonly #byAddress = new Map<string, number>();
  #total = 0;

  constructor(limits: AdmissionLimits) {
    this.#limits = limits;
  }

  get total(): number {
    return this.#total;
  }

  /** Why another connection from this address is refused, or null. */
  refusal(address: string): Extract<RejectReason, `too-many-connections${string}`> | null {
    if (this.#total >= this.#limits.maxConnections) return 'too-many-connections';
    const here = this.#byAddress.get(addressKey(address)) ?? 0;
    return here >= this.#limits.maxConnectionsPerAddress ? 'too-many-connections-per-address' : null;
  }

  /** @returns releases the place; call it once */
  enter(address: string): () => void {
    const key = addressKey(address);
    this.#total++;
    this.#byAddress.set(key, (this.#byAddress.get(key) ?? 0) + 1);
    return () => {
      this.#total--;
      const left = (this.#byAddress.get(key) ?? 1) - 1;
      if (left === 0) this.#byAddress.delete(key);
      else this.#byAddress.set(key, left);
    };
  }
}

/** The host that an address stands for: an IPv4 address, or the /64 prefix that a single IPv6 host usually has. */
export function addressKey(address: string): string {
  if (isIPv4(address)) return address;
  const [head = '', tail] = address.split('::', 2);
  const groups = head === '' ? [] : head.split(':');
  if (tail !== undefined) {
    const after = tail === '' ? [] : tail.split(':');
    while (groups.length + after.length < 8) groups.push('0');
    groups.push(...after);
  }
  return `${groups.slice(0, 4).join(':')}::/64`;
}

/** The peer's address: the socket's, or the one that the last proxy before us saw. */
export function peerAddress(request: IncomingMessage, trustProxy: boolean): string {
  const forwarded = request.headers['x-forwarded-for'];
  const last = typeof forwarded === 'string' ? forwarded.split(',').at(-1)?.trim() : undefined;
  const address = (trustProxy && last ? last : request.socket.remoteAddress) ?? 'unknown';
  return address.replace(/^::ffff:(?=\d+\.)/, '');
}
