import { allocate, type StreamClaim } from '@farpoint/congestion';
import { BitRate, RateMeter } from '@farpoint/timing';
import { pictureAllowance } from '../pictures/picture-plan.ts';

/** Margin on the measured rate of messages (answers to commands, session, telemetry), which come in bursts. */
const MESSAGE_MARGIN = 1.25;
/** Always reserved for messages, bit/s. */
const LEAST_MESSAGES = 20_000;

/** Margin on the measured rate of pictures. */
const PICTURE_MARGIN = 1.1;

/** Divides one operator's path among its streams. Messages come first: the robot must be able to say that it stops. */
export class PathBudget {
  readonly #messages = new RateMeter();
  readonly #pictures = new RateMeter();
  readonly #pictureShare: number;

  /** @param pictureShare the largest share of the path that pictures may take, 0–1 */
  constructor(pictureShare = 0) {
    this.#pictureShare = pictureShare;
  }

  /** @param messageBytes @param pictureBytes totals sent so far, including all headers */
  update(messageBytes: number, pictureBytes: number, nowMs: number): void {
    this.#messages.update(messageBytes, nowMs);
    this.#pictures.update(pictureBytes, nowMs);
  }

  /** How much of the path's target rate pictures may take, bit/s on the wire. */
  pictureBitsPerSecond(targetBitsPerSecond: number): number {
    const left = targetBitsPerSecond - this.#messageBitsPerSecond;
    return Math.max(0, Math.min(pictureAllowance(targetBitsPerSecond, this.#pictureShare), left));
  }

  /** How much of the path's target rate the cloud may take, bit/s on the wire. */
  cloudBitsPerSecond(targetBitsPerSecond: number): number {
    const messages = this.#messageBitsPerSecond;
    // The cloud gets whatever part of their allowance pictures do not use.
    const pictures = Math.min(
      BitRate.fromBytesPerSecond(this.#pictures.perSecond) * PICTURE_MARGIN,
      this.pictureBitsPerSecond(targetBitsPerSecond),
    );
    const claims: StreamClaim[] = [
      { name: 'messages', priority: 0, weight: 1, leastBitsPerSecond: messages, mostBitsPerSecond: messages },
      {
        name: 'pictures',
        priority: 1,
        weight: 1,
        leastBitsPerSecond: pictures,
        mostBitsPerSecond: pictures,
      },
      {
        name: 'cloud',
        priority: 2,
        weight: 1,
        leastBitsPerSecond: 0,
        mostBitsPerSecond: Number.POSITIVE_INFINITY,
      },
    ];
    return allocate(targetBitsPerSecond, claims).get('cloud') ?? 0;
  }

  get #messageBitsPerSecond(): number {
    return Math.max(BitRate.fromBytesPerSecond(this.#messages.perSecond) * MESSAGE_MARGIN, LEAST_MESSAGES);
  }
}
