import { allocate, RateMeter, type StreamClaim } from '@farpoint/congestion';

/** Messages (answers to commands, session, telemetry) are counted with this margin: they come in fits. */
const MESSAGE_MARGIN = 1.25;
/** Kept for them always, bit/s. */
const LEAST_MESSAGES = 20_000;

/** How the streams of one operator's path share what it carries. Messages first: the robot must be able to say that it stops. */
export class PathBudget {
  readonly #messages = new RateMeter();

  /** @param messageBytes sent so far, all headers counted */
  update(messageBytes: number, nowMs: number): void {
    this.#messages.update(messageBytes, nowMs);
  }

  /** What the cloud may take of the path's target, bit/s on the wire. */
  cloudBitsPerSecond(targetBitsPerSecond: number): number {
    const messages = Math.max(this.#messages.perSecond * 8 * MESSAGE_MARGIN, LEAST_MESSAGES);
    const claims: StreamClaim[] = [
      { name: 'messages', priority: 0, weight: 1, leastBitsPerSecond: messages, mostBitsPerSecond: messages },
      {
        name: 'cloud',
        priority: 1,
        weight: 1,
        leastBitsPerSecond: 0,
        mostBitsPerSecond: Number.POSITIVE_INFINITY,
      },
    ];
    return allocate(targetBitsPerSecond, claims).get('cloud') ?? 0;
  }
}
