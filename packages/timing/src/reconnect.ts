import { Backoff } from './backoff.ts';

const FIRST_RETRY_MS = 250;
/**
 * The longest wait between two attempts, ms, a second with its spread: short for as long as a network is usually away,
 * then kinder to the service.
 */
const MOST_RETRY_MS = 800;
const PATIENT_RETRY_MS = 10_000;
/** About three minutes of failures. */
const PATIENT_AFTER = 60;
const SHORT_MS = 2500;
const LONG_MS = 5000;

/**
 * How a peer comes back to signaling after its network was away. TCP repeats a lost SYN after 1, 3 and 7 s: who waits for
 * that misses the moment in which the network is back, so attempts are given up early and made anew. Every fourth may take
 * longer, for networks that are slow.
 */
export class Reconnect {
  readonly #quick: Backoff;
  readonly #patient: Backoff;
  #failures = 0;

  /** @param random uniform in [0, 1) */
  constructor(random: () => number) {
    this.#quick = new Backoff({ firstMs: FIRST_RETRY_MS, mostMs: MOST_RETRY_MS, random });
    this.#patient = new Backoff({ firstMs: MOST_RETRY_MS, mostMs: PATIENT_RETRY_MS, random });
  }

  /** How long the next attempt may take, from the first packet to the service's welcome, ms. */
  get timeoutMs(): number {
    return this.#failures % 4 === 3 ? LONG_MS : SHORT_MS;
  }

  /** After an attempt that failed, or a connection that broke. @returns ms to wait before the next */
  nextMs(): number {
    return this.#failures++ < PATIENT_AFTER ? this.#quick.nextMs() : this.#patient.nextMs();
  }

  /** After success. */
  reset(): void {
    this.#failures = 0;
    this.#quick.reset();
    this.#patient.reset();
  }
}
