import { Backoff } from './backoff.ts';

/** The first wait, ms. Chosen: a lost connection is often back at once. */
export const FIRST_RETRY_MS = 250;
/**
 * The longest wait between two attempts, ms; with its random spread, one second. Short for as long as a network is
 * usually down, later longer to spare the service.
 */
const MOST_RETRY_MS = 800;
/** The longest wait of the patient, ms. Chosen: a service that is back is found within ten seconds. */
const PATIENT_RETRY_MS = 10_000;
/** About three minutes of failures. */
const PATIENT_AFTER = 60;
/** How long an attempt may take, and every fourth, ms: see below. */
const SHORT_MS = 2500;
const LONG_MS = 5000;

/**
 * How a peer returns to signaling after a network outage. TCP repeats a lost SYN after 1, 3 and 7 s, and a peer that
 * waits for that misses the moment when the network returns. Attempts are therefore aborted early and repeated. Every
 * fourth attempt may take longer, for slow networks.
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

  /** Call after a failed attempt or a broken connection. @returns ms to wait before the next attempt */
  nextMs(): number {
    return this.#failures++ < PATIENT_AFTER ? this.#quick.nextMs() : this.#patient.nextMs();
  }

  /** Call after a success. */
  reset(): void {
    this.#failures = 0;
    this.#quick.reset();
    this.#patient.reset();
  }
}
