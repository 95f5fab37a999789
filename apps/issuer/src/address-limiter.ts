/** Limits how often each address may ask for something. Bounded; time is an argument. */
import { addressKey } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';

/** Beyond it, the address that was first seen longest ago is forgotten. */
const MOST_ADDRESSES = 10_000;

export class AddressLimiter {
  readonly #perMinute: number;
  readonly #buckets = new Map<string, TokenBucket>();

  constructor(perMinute: number) {
    this.#perMinute = perMinute;
  }

  /** @returns false if this address has asked too often */
  take(address: string, nowMs: number): boolean {
    const key = addressKey(address);
    let bucket = this.#buckets.get(key);
    if (bucket === undefined) {
      bucket = new TokenBucket({ perSecond: this.#perMinute / 60, burst: this.#perMinute });
      const [oldest] = this.#buckets.keys();
      if (this.#buckets.size >= MOST_ADDRESSES && oldest !== undefined) this.#buckets.delete(oldest);
      this.#buckets.set(key, bucket);
    }
    return bucket.take(nowMs);
  }
}
