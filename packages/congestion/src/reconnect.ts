/**
 * How a peer comes back to signaling after its network was away. TCP repeats a lost SYN after 1, 3 and 7 s: who waits for
 * that misses the moment in which the network is back, so attempts are given up early and made anew. Every third may take
 * long, for networks that are slow and not away.
 */

/** The longest wait between two attempts, ms. */
export const MOST_RETRY_MS = 1000;
const SHORT_MS = 2500;
const LONG_MS = 8000;

/**
 * @param attempt failed ones before this
 * @returns how long this attempt may take, from the first packet to the service's welcome, ms
 */
export function connectTimeoutMs(attempt: number): number {
  return attempt % 3 === 2 ? LONG_MS : SHORT_MS;
}
