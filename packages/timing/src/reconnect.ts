import { Backoff } from './backoff.ts';

const FIRST_RETRY_MS = 250;
/**
 * The longest wait between two attempts, ms; with its spread it is a second. It is short for as long as network outages
 * usually last; after that a longer wait spares the service.
 */
const MOST_RETRY_MS = 800;
const PATIENT_RETRY_MS = 10_000;
/** Number of failures with the short wait: about three minutes. */
const PATIENT_AFTER = 60;
const SHORT_MS = 2500;
const LONG_MS = 5000;

/**
 * Schedules how a peer reconnects to signaling after a network outage. TCP repeats a lost SYN after 1, 3 and 7 s.
 * Waiting for that would miss the moment at which the network is back, so attempts are given up early and repeated.
 * Every fourth may take longer, for slow networks.
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

  /** Call after a failed attempt or a broken connection. @returns the time to wait before the next attempt, ms */
  nextMs(): number {
    return this.#failures++ < PATIENT_AFTER ? this.#quick.nextMs() : this.#patient.nextMs();
  }

  /** Call after success. */
  reset(): void {
    this.#failures = 0;
    this.#quick.reset();
    this.#patient.reset();
  }
}
