import { allocate, type StreamClaim } from '@farpoint/congestion';
import type { LinkShares } from '@farpoint/protocol';
import { BitRate, RateMeter } from '@farpoint/timing';
import { pictureAllowance } from '../../sense/pictures/picture-plan.ts';
import { LEAST_VIDEO_BITS_PER_SECOND } from '../../sense/video/video-plan.ts';

/**
 * Margin on the measured rate of messages (answers to commands, session, telemetry), which come in bursts.
 * Chosen: bursts beyond it wait for a packet or two of points.
 */
const MESSAGE_MARGIN = 1.25;
/**
 * Always reserved for messages, bit/s. Chosen: it counts only until messages were measured; telemetry alone
 * is more.
 */
const LEAST_MESSAGES = 20_000;

/**
 * Margin on the measured rate of pictures. Chosen: their rate is planned, so that it varies by a picture's
 * size only.
 */
const PICTURE_MARGIN = 1.1;

/**
 * What a video's packets take besides the encoder's bits, as a factor. 76 bytes for each packet of up to
 * 1,180 are 6.4 %, and the last packet of a frame is shorter.
 */
const VIDEO_OVERHEAD = 1.08;
/**
 * Sound takes at most this share of what messages leave. Chosen: 46 kbit/s fit a path of some 160 kbit/s, and
 * there is still something to see (docs/sound.md).
 */
const SOUND_SHARE = 1 / 3;
/**
 * A paused video returns once its share is this much above the least, so that a changing rate does not switch
 * it. Chosen: more than an estimate moves on a steady link.
 */
const RETURN_MARGIN = 1.3;
/** Until the operator says otherwise, clouds count as much as two videos. */
const USUAL_SHARES: Omit<LinkShares, 'type'> = { cloud: 2, videos: [] };
/**
 * Weight of a video that the operator has not weighed: two of them count as much as a cloud
 * (docs/in-step.md).
 */
const USUAL_VIDEO = 1;

/** Highest rates of videos by number, bit/s without headers. */
export type VideoRates = ReadonlyMap<number, number>;

/** Divides one operator's path among its streams. Messages come first: the robot must be able to say that it stops. */
export class PathBudget {
  readonly #messages = new RateMeter();
  readonly #pictures = new RateMeter();
  readonly #pictureShare: number;
  #videos: () => VideoRates = () => new Map();
  #sound = 0;
  #weights = USUAL_SHARES;
  /** Videos whose share would be too small to show anything. */
  readonly #paused = new Set<number>();
  /** The latest result: several streams ask for their part of the same rate. */
  #divided: { targetBitsPerSecond: number; rates: ReadonlyMap<string, number> } | null = null;

  /** @param pictureShare the largest share of the path that pictures may take, 0–1 */
  constructor(pictureShare = 0) {
    this.#pictureShare = pictureShare;
  }

  /** @param messageBytes @param pictureBytes totals sent so far, including all headers */
  update(messageBytes: number, pictureBytes: number, nowMs: number): void {
    this.#messages.update(messageBytes, nowMs);
    this.#pictures.update(pictureBytes, nowMs);
    this.#divided = null;
  }

  /** How the operator wants clouds and videos weighed against each other. */
  weigh(shares: Omit<LinkShares, 'type'>): void {
    this.#weights = shares;
    this.#divided = null;
  }

  /** @param videos the videos that the operator wants and that have pictures; asked again at each update */
  wantVideos(videos: () => VideoRates): void {
    this.#videos = videos;
    this.#divided = null;
  }

  /** How much of the path's target rate pictures may take, bit/s on the wire. */
  pictureBitsPerSecond(targetBitsPerSecond: number): number {
    const left = targetBitsPerSecond - this.#messageBitsPerSecond - this.#sound;
    return Math.max(0, Math.min(pictureAllowance(targetBitsPerSecond, this.#pictureShare), left));
  }

  /** How much of the path's target rate the cloud may take, bit/s on the wire. */
  cloudBitsPerSecond(targetBitsPerSecond: number): number {
    return this.#divide(targetBitsPerSecond).get('cloud') ?? 0;
  }

  /** How much of the path's target rate sound may take, bit/s on the wire. */
  soundBitsPerSecond(targetBitsPerSecond: number): number {
    return Math.max(0, targetBitsPerSecond - this.#messageBitsPerSecond) * SOUND_SHARE;
  }

  /** @param bitsPerSecond what sound takes on the wire; 0 while none is sent */
  takeSound(bitsPerSecond: number): void {
    this.#sound = bitsPerSecond;
    this.#divided = null;
  }

  /** How much of the path's target rate a video may take, bit/s without headers; 0 if that would show nothing. */
  videoBitsPerSecond(video: number, targetBitsPerSecond: number): number {
    return (this.#divide(targetBitsPerSecond).get(videoClaim(video)) ?? 0) / VIDEO_OVERHEAD;
  }

  #divide(targetBitsPerSecond: number): ReadonlyMap<string, number> {
    if (this.#divided?.targetBitsPerSecond === targetBitsPerSecond) return this.#divided.rates;
    const first = this.#firstClaims(targetBitsPerSecond);
    const videos = this.#videos();
    for (const video of this.#paused) if (!videos.has(video)) this.#paused.delete(video);
    let sent = [...videos.keys()];
    let rates: ReadonlyMap<string, number>;
    for (;;) {
      rates = allocate(targetBitsPerSecond, [
        ...first,
        ...sent.map((video) => this.#videoClaim(video, videos.get(video) ?? 0)),
      ]);
      const thin = sent.filter((video) => this.#isTooThin(video, videos.get(video) ?? 0, rates));
      if (thin.length === 0) break;
      const least = thin.reduce((a, b) => (this.#weightOf(b) <= this.#weightOf(a) ? b : a));
      this.#paused.add(least);
      sent = sent.filter((video) => video !== least);
    }
    for (const video of sent) this.#paused.delete(video);
    this.#divided = { targetBitsPerSecond, rates };
    return rates;
  }

  #firstClaims(targetBitsPerSecond: number): StreamClaim[] {
    const messages = this.#messageBitsPerSecond;
    // The cloud gets whatever part of their allowance pictures do not use.
    const pictures = Math.min(
      BitRate.fromBytesPerSecond(this.#pictures.perSecond) * PICTURE_MARGIN,
      this.pictureBitsPerSecond(targetBitsPerSecond),
    );
    return [
      { name: 'messages', priority: 0, weight: 1, leastBitsPerSecond: messages, mostBitsPerSecond: messages },
      {
        name: 'sound',
        priority: 1,
        weight: 1,
        leastBitsPerSecond: this.#sound,
        mostBitsPerSecond: this.#sound,
      },
      { name: 'pictures', priority: 2, weight: 1, leastBitsPerSecond: pictures, mostBitsPerSecond: pictures },
      {
        name: 'cloud',
        priority: 3,
        weight: this.#weights.cloud,
        leastBitsPerSecond: 0,
        mostBitsPerSecond: Number.POSITIVE_INFINITY,
      },
    ];
  }

  #videoClaim(video: number, mostBitsPerSecond: number): StreamClaim {
    return {
      name: videoClaim(video),
      priority: 3,
      weight: this.#weightOf(video),
      leastBitsPerSecond: 0,
      mostBitsPerSecond: mostBitsPerSecond * VIDEO_OVERHEAD,
    };
  }

  #isTooThin(video: number, mostBitsPerSecond: number, rates: ReadonlyMap<string, number>): boolean {
    const rate = (rates.get(videoClaim(video)) ?? 0) / VIDEO_OVERHEAD;
    const least = LEAST_VIDEO_BITS_PER_SECOND * (this.#paused.has(video) ? RETURN_MARGIN : 1);
    // Rounding must not pause a video that has all that it can use.
    return rate < Math.min(least, mostBitsPerSecond * 0.999);
  }

  #weightOf(video: number): number {
    return this.#weights.videos[video] ?? USUAL_VIDEO;
  }

  get #messageBitsPerSecond(): number {
    return Math.max(BitRate.fromBytesPerSecond(this.#messages.perSecond) * MESSAGE_MARGIN, LEAST_MESSAGES);
  }
}

function videoClaim(video: number): string {
  return `video ${video}`;
}
