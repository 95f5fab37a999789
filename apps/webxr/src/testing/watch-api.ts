/** `window.farpointWatch`: what end-to-end tests and benchmarks can read from the watchers' page. */
import type { Distribution, WatchState } from '@farpoint/operator';
import type { WatchApp } from '../page/watch/watch-app.ts';
import type { VideoStats } from '../take/video/video-figures.ts';

export interface WatchStats {
  state: WatchState;
  /** How often it began to watch. */
  attempts: number;
  videos: VideoStats;
  /** Of the first sensor. */
  cloud: {
    frames: number;
    packets: number;
    points: number;
    /** How far the capture of the clouds that are drawn lies after that of the videos that are shown, ms. */
    aheadMs: Distribution | null;
    /** How long clouds waited, ms. */
    heldMs: Distribution | null;
  };
  /** Display frames drawn. */
  drawnFrames: number;
}

export interface WatchApi {
  stats(): WatchStats;
  resetDistributions(): void;
  /** Draws a picture in the panel of a video, as if its camera had sent one. */
  showPicture(video: number): void;
}

declare global {
  interface Window {
    farpointWatch?: WatchApi;
  }
}

export function installWatchApi(app: WatchApp): void {
  window.farpointWatch = {
    stats: () => {
      const { frames, packets, points } = app.cloud;
      return {
        ...{ state: app.state, attempts: app.watcher.attempts, drawnFrames: app.drawnFrames },
        videos: app.videos.stats(performance.now()),
        cloud: { frames, packets, points, ...app.hold.stats },
      };
    },
    resetDistributions: () => {
      app.videos.resetDistributions();
      app.hold.resetDistributions();
    },
    showPicture: (video) => {
      const picture = new OffscreenCanvas(16, 12);
      picture.getContext('2d')?.fillRect(0, 0, 16, 12);
      const nowMs = performance.now();
      app.views.views.peek()[video]?.draw(picture, 16, 12, nowMs, nowMs);
    },
  };
}
