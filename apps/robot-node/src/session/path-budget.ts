import { allocate, type StreamClaim } from '@farpoint/congestion';
import { BitRate, RateMeter } from '@farpoint/timing';
import { pictureAllowance } from '../pictures/picture-plan.ts';

/** Messages (answers to commands, session, telemetry) are counted with this margin: they come in fits. */
const MESSAGE_MARGIN = 1.25;
/** Kept for them always, bit/s. */
const LEAST_MESSAGES = 20_000;

/** Pictures are counted with this one. */
const PICTURE_MARGIN = 1.1;

/** How the streams of one operator's path share what it carries. Messages first: the robot must be able to say that it stops. */
export class PathBudget {
  readonly #messages = new RateMeter();
  readonly #pictures = new RateMeter();
  readonly #pictureShare: number;

  /** @param pictureShare most of the path that pictures may take, 0–1 */
  constructor(pictureShare = 0) {
    this.#pictureShare = pictureShare;
  }

  /** @param messageBytes @param pictureBytes sent so far, all headers counted */
  update(messageBytes: number, pictureBytes: number, nowMs: number): void {
    this.#messages.update(messageBytes, nowMs);
    this.#pictures.update(pictureBytes, nowMs);
  }

  /** What pictures may take of the path's target, bit/s on the wire. */
  pictureBitsPerSecond(targetBitsPerSecond: number): number {
    const left = targetBitsPerSecond - this.#messageBitsPerSecond;
    return Math.max(0, Math.min(pictureAllowance(targetBitsPerSecond, this.#pictureShare), left));
  }

  /** What the cloud may take of the path's target, bit/s on the wire. */
  cloudBitsPerSecond(targetBitsPerSecond: number): number {
    const messages = this.#messageBitsPerSecond;
    // What they may take and do not is the cloud's.
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
