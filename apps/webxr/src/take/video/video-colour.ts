/**
 * Paints clouds with the video of the camera that they come from, where the robot sends one: each frame of the cloud with
 * the video's picture of the same capture instant, and with the packets' own colours where there is none.
 */

import type { CloudView, PictureUse } from '@farpoint/cloud-view';
import type { Batch, CloudHold, RobotClient, VideoDescription } from '@farpoint/operator';
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { STALE_MS } from '../../ground/pictures/camera-view.ts';
import type { VideoImage } from './readers/video-image.ts';
import type { VideoFeed } from './video-feed.ts';
import type { VideoViews } from './video-views.ts';

/** Where a surface's colours come from, and if not from a video, why. */
export type VideoColourState =
  | 'painted'
  /** No video is of the camera that the clouds come from. */
  | 'not-offered'
  | 'switched-off'
  /** Pictures do not wait for what was captured with them. */
  | 'not-in-step'
  /** Nobody watches the video, so it is not sent. */
  | 'not-watched'
  /** The cloud is drawn as points. */
  | 'no-surface'
  /** Its colours show something else, e.g. heights. */
  | 'other-colours'
  /** Pictures come, but cannot be used, or none was captured with the cloud. */
  | 'no-match'
  /** Pictures come only when the next cloud is drawn already. */
  | 'late'
  /** No picture comes. */
  | 'no-picture';

export interface VideoColourFigures {
  state: VideoColourState;
  /** How much of the colours the video gives at present, 0–1. */
  share: number;
  /** What became of the newest picture; `null` before the first. */
  use: PictureUse | null;
  /** What became of the video's pictures since the session began. */
  pictures: Partial<Record<PictureUse, number>>;
}

export interface VideoColourParts {
  readonly client: Pick<RobotClient, 'on'>;
  readonly feed: Pick<VideoFeed, 'onFrame'>;
  readonly hold: Pick<CloudHold, 'exact'>;
  readonly views: Pick<VideoViews, 'switches'>;
  /** What draws each sensor's cloud, by sensor number. */
  readonly clouds: ReadonlySignal<readonly Pick<CloudView, 'paint' | 'isSurface' | 'colouring'>[]>;
  /** Whether videos and clouds are shown in step: follows a setting that is a signal. */
  readonly settings: { readonly synchronised: boolean };
  /** Whether the operator wants it. */
  readonly wanted: ReadonlySignal<boolean>;
}

/** Less is no painting. */
const LEAST_SHARE = 0.05;

export class VideoColour {
  readonly #parts: VideoColourParts;
  #videos: readonly VideoDescription[] = [];
  #pictures: Partial<Record<PictureUse, number>> = {};
  #use: PictureUse | null = null;
  #cameMs = Number.NEGATIVE_INFINITY;
  #matchedMs = Number.NEGATIVE_INFINITY;
  #nowMs = 0;

  constructor(parts: VideoColourParts) {
    this.#parts = parts;
    const { client, feed, clouds, settings, wanted } = parts;
    client.on('session', () => {
      this.#videos = [];
      this.#pictures = {};
      this.#use = null;
      this.#cameMs = this.#matchedMs = Number.NEGATIVE_INFINITY;
    });
    client.on('videos', (videos) => {
      this.#videos = videos;
    });
    // Pictures are sorted out for the first sensor only; those of others are all kept for a while.
    client.on('cloud', (batch) => this.#expect(batch));
    feed.onFrame = (video, image, captureMs, nowMs) => this.#take(video, image, captureMs, nowMs);
    effect(() => {
      for (const { paint } of clouds.value) paint.on = settings.synchronised && wanted.value;
    });
  }

  /**
   * Decides whether clouds wait for their own pictures: only while some come after them. Call this a few times
   * a second.
   */
  update(nowMs: number): void {
    this.#nowMs = nowMs;
    this.#parts.hold.exact = nowMs - this.#matchedMs < STALE_MS && this.#share !== null;
  }

  get figures(): VideoColourFigures {
    const pictures = { ...this.#pictures };
    return { state: this.#state, share: this.#share ?? 0, use: this.#use, pictures };
  }

  /** Of the robot's list, the video that paints a sensor's clouds; −1: none. */
  #videoOf(sensor: number): number {
    return this.#videos.findIndex(({ ofSensor }) => ofSensor === sensor);
  }

  /** `null`: nothing that the video might paint is drawn. */
  get #share(): number | null {
    const shares = this.#parts.clouds.peek().flatMap(({ paint, isSurface, colouring }) => {
      return isSurface && colouring.mode === 'captured' && paint.on ? [paint.share] : [];
    });
    return shares.length === 0 ? null : Math.max(...shares);
  }

  get #state(): VideoColourState {
    const { clouds, views, settings, wanted } = this.#parts;
    const all = clouds.peek();
    const sensor = all.findIndex((_, number) => this.#videoOf(number) >= 0);
    const view = all[sensor];
    if (view === undefined) return 'not-offered';
    if (!wanted.peek()) return 'switched-off';
    if (!settings.synchronised) return 'not-in-step';
    if ((this.#share ?? 0) > LEAST_SHARE) return 'painted';
    if (!views.switches.wanted.peek().includes(this.#videoOf(sensor))) return 'not-watched';
    if (!view.isSurface) return 'no-surface';
    if (view.colouring.mode !== 'captured') return 'other-colours';
    if (this.#nowMs - this.#cameMs > STALE_MS) return 'no-picture';
    return this.#use === 'matched' ? 'late' : 'no-match';
  }

  #expect(batch: Batch): void {
    const { clouds, wanted } = this.#parts;
    const view = clouds.peek()[batch.sensor];
    // A page that nobody sees has released it already.
    if (view === undefined || batch.buffer.byteLength === 0) return;
    if (!wanted.peek() || this.#videoOf(batch.sensor) < 0) return;
    for (let packet = 0; packet < batch.packets; packet++) view.paint.expect(batch.captureTimeUs(packet));
  }

  #take(video: number, { image, width, height }: VideoImage, captureMs: number, nowMs: number): void {
    const { clouds, settings, wanted } = this.#parts;
    const sensor = this.#videos[video]?.ofSensor;
    const view = sensor === undefined ? undefined : clouds.peek()[sensor];
    if (view === undefined || !settings.synchronised || !wanted.peek()) return;
    this.#cameMs = nowMs;
    const use = view.paint.take({ image, width, height }, stampUs(captureMs));
    this.#use = use;
    if (use === 'matched') this.#matchedMs = nowMs;
    this.#pictures[use] = (this.#pictures[use] ?? 0) + 1;
  }
}

/** As clouds' packets carry it: µs modulo 2³². */
function stampUs(captureMs: number): number {
  return ((Math.round(captureMs * 1000) % 2 ** 32) + 2 ** 32) % 2 ** 32;
}
