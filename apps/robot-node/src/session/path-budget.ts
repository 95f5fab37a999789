import { allocate, type StreamClaim } from '@farpoint/congestion';
import { BitRate, RateMeter } from '@farpoint/timing';
import { pictureAllowance } from '../pictures/picture-plan.ts';

/** Margin on the measured rate of messages (answers to commands, session, telemetry), which come in bursts. */
const MESSAGE_MARGIN = 1.25;
/** Always reserved for messages, bit/s. */
const LEAST_MESSAGES = 20_000;

/** Margin on the measured rate of pictures. */
const PICTURE_MARGIN = 1.1;

/** What a video's packets take besides the encoder's bits, as a factor. */
const VIDEO_OVERHEAD = 1.08;
/** Sound takes at most this share of what messages leave. */
const SOUND_SHARE = 1 / 3;

/** Clouds count as much as this many videos where both want more than there is. */
const CLOUD_WEIGHT = 2;

/** Divides one operator's path among its streams. Messages come first: the robot must be able to say that it stops. */
export class PathBudget {
  readonly #messages = new RateMeter();
  readonly #pictures = new RateMeter();
  readonly #pictureShare: number;
  #videos: ReadonlyMap<number, number> = new Map();
  #sound = 0;

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
    const left = targetBitsPerSecond - this.#messageBitsPerSecond - this.#sound;
    return Math.max(0, Math.min(pictureAllowance(targetBitsPerSecond, this.#pictureShare), left));
  }

  /** How much of the path's target rate the cloud may take, bit/s on the wire. */
  cloudBitsPerSecond(targetBitsPerSecond: number): number {
    return this.#shares(targetBitsPerSecond).get('cloud') ?? 0;
  }

  /**
   * What the operator's videos may use.
   *
   * @param most by video, its highest rate without headers, bit/s
   */
  wantVideos(most: ReadonlyMap<number, number>): void {
    this.#videos = most;
  }

  /** How much of the path's target rate sound may take, bit/s on the wire. */
  soundBitsPerSecond(targetBitsPerSecond: number): number {
    return Math.max(0, targetBitsPerSecond - this.#messageBitsPerSecond) * SOUND_SHARE;
  }

  /** @param bitsPerSecond what sound takes on the wire; 0 while none is sent */
  takeSound(bitsPerSecond: number): void {
    this.#sound = bitsPerSecond;
  }

  /** How much of the path's target rate a video may take, bit/s without headers. */
  videoBitsPerSecond(video: number, targetBitsPerSecond: number): number {
    return (this.#shares(targetBitsPerSecond).get(videoClaim(video)) ?? 0) / VIDEO_OVERHEAD;
  }

  #shares(targetBitsPerSecond: number): ReadonlyMap<string, number> {
    const messages = this.#messageBitsPerSecond;
    // The cloud gets whatever part of their allowance pictures do not use.
    const pictures = Math.min(
      BitRate.fromBytesPerSecond(this.#pictures.perSecond) * PICTURE_MARGIN,
      this.pictureBitsPerSecond(targetBitsPerSecond),
    );
    const claims: StreamClaim[] = [
      { name: 'messages', priority: 0, weight: 1, leastBitsPerSecond: messages, mostBitsPerSecond: messages },
      {
        name: 'sound',
        priority: 1,
        weight: 1,
        leastBitsPerSecond: this.#sound,
        mostBitsPerSecond: this.#sound,
      },
      {
        name: 'pictures',
        priority: 2,
        weight: 1,
        leastBitsPerSecond: pictures,
        mostBitsPerSecond: pictures,
      },
      {
        name: 'cloud',
        priority: 3,
        weight: CLOUD_WEIGHT,
        leastBitsPerSecond: 0,
        mostBitsPerSecond: Number.POSITIVE_INFINITY,
      },
      ...[...this.#videos].map(([video, bitsPerSecond]) => ({
        name: videoClaim(video),
        priority: 3,
        weight: 1,
        leastBitsPerSecond: 0,
        mostBitsPerSecond: bitsPerSecond * VIDEO_OVERHEAD,
      })),
    ];
    return allocate(targetBitsPerSecond, claims);
  }

  get #messageBitsPerSecond(): number {
    return Math.max(BitRate.fromBytesPerSecond(this.#messages.perSecond) * MESSAGE_MARGIN, LEAST_MESSAGES);
  }
}

function videoClaim(video: number): string {
  return `video ${video}`;
}
