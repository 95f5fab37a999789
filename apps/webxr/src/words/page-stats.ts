/** Figures of the stream ({@link StreamStats}) and of the drawing. Time is an argument. */

import { type Distribution, type DropCounts, SampleWindow, type StreamStats } from '@farpoint/operator';
import { RateMeter } from '@farpoint/timing';
import type { VideoColourFigures } from '../take/video/video-colour.ts';
import type { VideoStats } from '../take/video/video-figures.ts';
import type { ViewFigures } from './view-words.ts';

export interface PageStats extends StreamStats {
  /** Since the session began. */
  framesDrawn: number;
  pointsDrawn: number;
  /** Over the last second. */
  framesPerSecond: number;
  pointsPerFrame: number;
  /** Only about one of this many points is drawn, because this computer is too slow for more; 1: all. */
  drawnOneOf: number;
  /** What of the remembered world is in view; `null`: nothing. */
  remembered: RememberedFigures | null;
  /** Milliseconds of the frame loop's own work. In the test build with `?measure=1` it includes the time until the GPU has finished. */
  renderMs: Distribution | null;
  displayFramesPerSecond: number;
  /**
   * Age of what the operator sees, ms: as the robot judges it while commands come, otherwise of the newest capture on the
   * screen; `null` while unknown.
   */
  viewAgeMs: number | null;
  canvas: { width: number; height: number };
  /** How the cameras' videos are presented. */
  videos: VideoStats;
  /** Whether the view is predicted. */
  view?: ViewFigures | undefined;
  /** Whether the surface has the colours of its camera's video. */
  videoColour?: VideoColourFigures | undefined;
}

/** What of the remembered world is in view. */
export interface RememberedFigures {
  points: number;
  /** How long ago the oldest of it was seen, seconds. */
  oldestS: number;
}

/** What of the cloud has been drawn since the session began. */
export interface DrawnCounts {
  readonly frames: number;
  readonly points: number;
  readonly drops: DropCounts;
}

export class PageStatistics {
  readonly #render = new SampleWindow(512);
  readonly #frames = new RateMeter();
  readonly #points = new RateMeter();
  readonly #display = new RateMeter();
  readonly #possible = new RateMeter();
  #displayFrames = 0;
  #sparedFrames = 0;
  /** Set by what governs the drawing. */
  drawnOneOf = 1;
  /** Set by what draws the remembered world. */
  remembered: RememberedFigures | null = null;

  /** Starts a new session. */
  reset(): void {
    this.#frames.reset();
    this.#points.reset();
  }

  /** Empties the distributions. */
  resetDistributions(): void {
    this.#render.clear();
  }

  onDrawn(renderMs: number): void {
    this.#displayFrames++;
    this.#render.add(renderMs);
  }

  /** A display frame could have been drawn, but nothing new was to be seen. */
  onSpared(): void {
    this.#sparedFrames++;
  }

  /** Updates the rates. Call this a few times a second. */
  update(drawn: DrawnCounts, nowMs: number): void {
    this.#frames.update(drawn.frames, nowMs);
    this.#points.update(drawn.points, nowMs);
    this.#display.update(this.#displayFrames, nowMs);
    this.#possible.update(this.#displayFrames + this.#sparedFrames, nowMs);
  }

  get displayFramesPerSecond(): number {
    return this.#display.perSecond;
  }

  /** Display frames a second that this computer could draw, whether or not there was something new. */
  get possibleFramesPerSecond(): number {
    return this.#possible.perSecond;
  }

  snapshot(
    stream: StreamStats,
    drawn: DrawnCounts,
    { canvas, videos, viewAgeMs }: Pick<PageStats, 'canvas' | 'videos' | 'viewAgeMs'>,
  ): PageStats {
    const drops: DropCounts = { ...stream.drops };
    for (const [reason, count] of Object.entries(drawn.drops)) {
      drops[reason as keyof DropCounts] = (drops[reason as keyof DropCounts] ?? 0) + count;
    }
    const frames = this.#frames.perSecond;
    return {
      ...stream,
      drops,
      framesDrawn: drawn.frames,
      pointsDrawn: drawn.points,
      framesPerSecond: frames,
      pointsPerFrame: frames > 0 ? this.#points.perSecond / frames : 0,
      renderMs: this.#render.distribution(),
      drawnOneOf: this.drawnOneOf,
      remembered: this.remembered,
      displayFramesPerSecond: this.#display.perSecond,
      viewAgeMs,
      canvas: { width: canvas.width, height: canvas.height },
      videos,
    };
  }
}
