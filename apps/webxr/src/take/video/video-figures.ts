/** Figures of the videos' presentation. Time is an argument. */
import { type CompositorStats, type Distribution, SampleWindow } from '@farpoint/operator';
import { RateMeter } from '@farpoint/timing';
import type { VideoReceiverName } from '../../ground/settings.ts';

/** The name under which the compositor is offered clouds. */
export const CLOUD = 'cloud';

/** What was shown of one video. */
export interface ShownVideoStats {
  /** Index in the robot's list. */
  video: number;
  /** Frames shown since the session began. */
  frames: number;
  /** Over the last second. */
  framesPerSecond: number;
  /** From capture until it was drawn, by the robot's clock, ms. */
  ageMs: Distribution | null;
}

/** How the videos were presented: together (`CompositorStats`), and each of them. */
export interface VideoStats extends CompositorStats {
  /** How this browser receives them; `null` if it cannot. */
  receiver: VideoReceiverName | null;
  /** Frames of the videos that are on that arrived and were not decoded, by reason, where the browser lets that be known. */
  undecoded: Record<string, number>;
  /** The videos that were shown, by number. */
  videos: ShownVideoStats[];
  /** Frames whose time cannot be, or that came before the robot's clock was known. */
  undated: number;
}

/** Ages of pictures that figures are taken from: 17 s at 30 a second, a benchmark's look. */
const AGES_KEPT = 512;

interface Counts {
  frames: number;
  readonly rate: RateMeter;
  readonly age: SampleWindow;
}

export class VideoFigures {
  undated = 0;
  readonly #videos = new Map<number, Counts>();

  /** A session begins. */
  reset(): void {
    this.undated = 0;
    this.#videos.clear();
  }

  resetDistributions(): void {
    for (const { age } of this.#videos.values()) age.clear();
  }

  onShown(video: number, ageMs: number): void {
    let counts = this.#videos.get(video);
    if (counts === undefined) {
      counts = { frames: 0, rate: new RateMeter(), age: new SampleWindow(AGES_KEPT) };
      this.#videos.set(video, counts);
    }
    counts.frames++;
    counts.age.add(ageMs);
  }

  /** Updates the rates. Call this a few times a second. */
  update(nowMs: number): void {
    for (const { frames, rate } of this.#videos.values()) rate.update(frames, nowMs);
  }

  snapshot(compositor: CompositorStats): Omit<VideoStats, 'receiver' | 'undecoded'> {
    const videos = [...this.#videos].map(([video, { frames, rate, age }]) => ({
      video,
      frames,
      framesPerSecond: rate.perSecond,
      ageMs: age.distribution(),
    }));
    videos.sort((a, b) => a.video - b.video);
    return { ...compositor, videos, undated: this.undated };
  }
}
