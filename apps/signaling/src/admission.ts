import { addressKey } from '@farpoint/service';
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
