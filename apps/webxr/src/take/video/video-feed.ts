/**
 * Brings the robot's videos to their canvases: reads the tracks of those that are on, and draws together the frames that
 * were captured together.
 */
import {
  type Batch,
  Compositor,
  captureMsOfRtp,
  captureMsOfStamp,
  type RobotClient,
  type VideoCodec,
  type VideoDescription,
  type VideoTrack,
} from '@farpoint/operator';
import { effect, signal, untracked } from '@preact/signals-core';
import type { PresentedInstant } from '../../ground/telemetry/presented-instant.ts';
import type { Reader, ReadFrame } from './readers/open-reader.ts';
import type { VideoImage } from './readers/video-image.ts';
import { CLOUD, VideoFigures, type VideoStats } from './video-figures.ts';
import type { VideoReceiver } from './video-receiver.ts';
import type { VideoViews } from './video-views.ts';

/**
 * What is farther from now than this was not captured then: its sender counts time otherwise, ms. Chosen:
 * clocks that were compared are never off by so much; older pictures than a minute are nothing to look at.
 */
const MOST_AHEAD_MS = 1000;
const MOST_BEHIND_MS = 60_000;

/** What is known of a frame's time. */
export interface FrameTimes {
  readonly rtpTimestamp: number | null;
  /** Page's clock, ms. */
  readonly capturedAtMs: number | null;
}

/**
 * When a frame was captured: ms on the robot's clock. `null` if it says something that cannot be.
 *
 * @param offsetMs robot's clock minus page's clock
 * @param nowMs page's clock
 */
export function captureMsOf(
  { rtpTimestamp, capturedAtMs }: FrameTimes,
  offsetMs: number,
  nowMs: number,
): number | null {
  const robotNowMs = nowMs + offsetMs;
  const captureMs =
    rtpTimestamp !== null ? captureMsOfRtp(rtpTimestamp, robotNowMs) : (capturedAtMs ?? nowMs) + offsetMs;
  const aheadMs = captureMs - robotNowMs;
  return aheadMs <= MOST_AHEAD_MS && aheadMs >= -MOST_BEHIND_MS ? captureMs : null;
}

const VIDEO = 'video:';

/** Where the videos come from: a {@link RobotClient}, or an object with the same interface. */
export interface VideoSource {
  readonly on: RobotClient['on'];
  readonly link: { readonly session: { readonly clock: { readonly offsetMs: number | null } } };
}

export interface VideoFeedParts {
  readonly client: VideoSource;
  readonly views: VideoViews;
  /** Why this browser cannot show a video. */
  readonly words: Readonly<Record<'tooOld' | 'noCodec', string>>;
  /** Whether frames wait for what was captured at the same time: follows a setting that is a signal. */
  readonly settings: { readonly synchronised: boolean };
  /** `null` if this browser cannot read videos. */
  readonly receiver: VideoReceiver | null;
  /** Told when the newest frame that is now shown was captured, ms on the robot's clock. */
  onShown?(captureMs: number): void;
  /** Told of the instant that is shown; `null` if nobody asks. */
  readonly presented: PresentedInstant | null;
  /**
   * When a video's frame was captured, ms on the robot's clock, or `null`; default: as its timestamp says, which a relay
   * would have rewritten.
   */
  captureMs?(video: number, frame: ReadFrame): number | null;
  /** Page's clock, ms. */
  now(): number;
}

export class VideoFeed {
  readonly #parts: VideoFeedParts;
  /** A cloud has no payload: its points are drawn as they come, and only the videos wait. */
  readonly #compositor: Compositor<VideoImage | null>;
  readonly #figures = new VideoFigures();
  readonly #tracks = signal<ReadonlyMap<number, VideoTrack>>(new Map());
  #listed: readonly VideoDescription[] = [];
  readonly #readers = new Map<number, Reader>();
  /** Called after each presentation has been drawn. */
  onPresented: (() => void) | null = null;
  /** Called with each frame as it comes, before it waits to be presented; the image is closed later. Capture: robot's clock, ms. */
  onFrame: ((video: number, image: VideoImage, captureMs: number, nowMs: number) => void) | null = null;
  /** The newest capture instant of what is shown of the videos, ms on the robot's clock; `null` before the first. */
  shownMs: number | null = null;
  /** When the shown frame of each video was captured, ms on the robot's clock. */
  readonly captureMs = new Map<number, number>();
  /** The cloud's frame that was offered last. */
  #cloudFrame: number | null = null;

  /** Make it before anything that takes the `cloud` event's batches. */
  constructor(parts: VideoFeedParts) {
    this.#parts = parts;
    const { client, views, settings } = parts;
    this.#compositor = new Compositor({
      onDrop: ({ payload }) => payload?.close(),
      holds: (source) => source.startsWith(VIDEO),
    });
    effect(() => {
      this.#compositor.synchronised = settings.synchronised;
    });
    client.on('session', () => this.#reset());
    client.on('videos', (videos) => this.#onList(videos));
    client.on('videoTrack', (track) => this.#onTrack(track));
    client.on('cloud', (batch) => this.#onCloud(batch));
    effect(() => {
      const wanted = views.switches.wanted.value;
      const tracks = this.#tracks.value;
      untracked(() => this.#readOnly(wanted.filter((video) => tracks.has(video))));
    });
  }

  /** Draws what is to be shown from now on. Call it for each display frame. */
  present(nowMs: number): void {
    const presentation = this.#compositor.decide(nowMs);
    if (presentation === null) return;
    const { client, views, presented } = this.#parts;
    presented?.show(presentation.instantMs, nowMs);
    for (const { source, captureMs, payload } of presentation.items) {
      if (payload === null) continue;
      this.shownMs = Math.max(this.shownMs ?? captureMs, captureMs);
      const video = Number(source.slice(VIDEO.length));
      this.captureMs.set(video, captureMs);
      const takenAtMs = captureMs - (client.link.session.clock.offsetMs ?? 0);
      views.show(video, payload, takenAtMs, nowMs);
      this.#figures.onShown(video, nowMs - takenAtMs);
    }
    if (this.shownMs !== null) this.#parts.onShown?.(this.shownMs);
    this.onPresented?.();
  }

  /** What the robot encodes a video with now; `null` if it has said nothing of it. */
  codecOf(video: number): VideoCodec | null {
    return this.#listed[video]?.codec ?? null;
  }

  /** Call this a few times a second. */
  measure(nowMs: number): void {
    this.#figures.update(nowMs);
  }

  stats(nowMs: number): VideoStats {
    const receiver = this.#parts.receiver?.name ?? null;
    const undecoded: Record<string, number> = {};
    for (const reader of this.#readers.values())
      for (const [reason, count] of Object.entries(reader.undecoded ?? {}))
        undecoded[reason] = (undecoded[reason] ?? 0) + count;
    return { receiver, undecoded, ...this.#figures.snapshot(this.#compositor.stats(nowMs)) };
  }

  resetDistributions(): void {
    this.#figures.resetDistributions();
    this.#compositor.resetDistributions();
  }

  #reset(): void {
    this.#readOnly([]);
    this.#tracks.value = new Map();
    this.#compositor.clear();
    this.#parts.presented?.clear();
    this.#figures.reset();
    this.#cloudFrame = null;
    this.shownMs = null;
    this.captureMs.clear();
  }

  /** The robot encodes a video with the codec that suits those who watch: it may change. */
  #onList(videos: readonly VideoDescription[]): void {
    const before = this.#listed;
    this.#listed = videos;
    for (const [video, reader] of this.#readers) {
      const codec = videos[video]?.codec;
      if (codec === undefined || codec === before[video]?.codec) continue;
      this.#parts.views.mayShow(video);
      reader.useCodec?.(codec);
    }
  }

  #onTrack(videoTrack: VideoTrack): void {
    const { views, receiver, words } = this.#parts;
    const { video, track } = videoTrack;
    // It has ended if the browser has refused the video's line in the robot's offer.
    const ended = track.readyState === 'ended';
    if (receiver === null || ended) {
      views.cannotShow(video, ended ? words.noCodec : words.tooOld);
      return;
    }
    // Without the video for a moment, so that the reader of its earlier track ends.
    const others = [...this.#tracks.peek()].filter(([number]) => number !== video);
    this.#tracks.value = new Map(others);
    this.#tracks.value = new Map(others).set(video, videoTrack);
  }

  /** Reads these videos and no others. */
  #readOnly(videos: readonly number[]): void {
    for (const [video, reader] of this.#readers) {
      if (videos.includes(video)) continue;
      reader.close();
      this.#readers.delete(video);
      this.#compositor.remove(VIDEO + video);
    }
    for (const video of videos) {
      const track = this.#tracks.peek().get(video);
      const { receiver } = this.#parts;
      const codec = this.#listed[video]?.codec;
      if (receiver === null || track === undefined || codec === undefined) continue;
      if (this.#readers.has(video)) continue;
      const reader = receiver.open(
        { ...track, codec },
        {
          onFrame: (frame) => this.#onFrame(video, frame),
          onUnsupported: (detail) => {
            console.warn(`video ${video} cannot be decoded:`, detail);
            this.#parts.views.cannotShow(video, this.#parts.words.noCodec);
          },
        },
      );
      this.#readers.set(video, reader);
    }
  }

  #onFrame(video: number, frame: ReadFrame): void {
    const nowMs = this.#parts.now();
    const { offsetMs } = this.#parts.client.link.session.clock;
    const { captureMs: captureMsOfFrame } = this.#parts;
    const captureMs =
      captureMsOfFrame !== undefined
        ? captureMsOfFrame(video, frame)
        : offsetMs === null
          ? null
          : captureMsOf(frame, offsetMs, nowMs);
    if (captureMs === null) {
      this.#figures.undated++;
      frame.image.close();
      return;
    }
    this.onFrame?.(video, frame.image, captureMs, nowMs);
    this.#compositor.offer(VIDEO + video, captureMs, frame.image, nowMs);
  }

  /** A video's frame waits for the first points of the cloud that was captured with it. */
  #onCloud(batch: Batch): void {
    const { offsetMs } = this.#parts.client.link.session.clock;
    if (offsetMs === null) return;
    const nowMs = this.#parts.now();
    for (let packet = 0; packet < batch.packets; packet++) {
      const frame = batch.frameNumber(packet);
      if (frame === this.#cloudFrame) continue;
      this.#cloudFrame = frame;
      const captureMs = captureMsOfStamp(batch.captureTimeUs(packet), nowMs + offsetMs);
      // Without videos, points are all that is shown, and they are shown at once.
      if (this.#readers.size === 0) this.#parts.presented?.show(captureMs, nowMs);
      else this.#compositor.offer(CLOUD, captureMs, null, nowMs);
    }
  }
}
