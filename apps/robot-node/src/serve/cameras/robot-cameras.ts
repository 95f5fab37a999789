import { PictureHub, type PictureHubOptions, type PictureTarget } from '../../send/pictures/picture-hub.ts';
import type { VideoCamera } from '../../sense/video/video-encoder.ts';
import { VideoHub, type VideoHubOptions, type VideoTarget } from '../../sense/video/video-hub.ts';

export interface RobotCamerasOptions
  extends Omit<PictureHubOptions, 'targets'>,
    Pick<VideoHubOptions, 'onStateChanged' | 'onFrame' | 'taker'> {
  videos: readonly VideoCamera[];
  targets: () => Iterable<PictureTarget>;
  videoTargets: () => Iterable<VideoTarget>;
}

/** Everything that the robot's cameras show beside the clouds: a few pictures a second of some, video of others. */
export class RobotCameras {
  /** `null` if no camera shows pictures. */
  readonly pictures: PictureHub | null;
  readonly videos: VideoHub;

  constructor({
    policy,
    capture,
    targets,
    videoTargets,
    driver,
    onMade,
    onStateChanged,
    onFrame,
    taker,
    videos,
    log,
  }: RobotCamerasOptions) {
    this.pictures =
      capture.cameras.length === 0 ? null : new PictureHub({ policy, capture, targets, driver, onMade, log });
    this.videos = new VideoHub({
      cameras: videos,
      targets: videoTargets,
      driver,
      onStateChanged,
      onFrame,
      taker,
      log,
    });
  }

  /** Updates the plans of all cameras. Call often. */
  update(nowMs: number): void {
    this.pictures?.update(nowMs);
    this.videos.update(nowMs);
  }

  async close(): Promise<void> {
    await Promise.all([this.pictures?.close(), this.videos.close()]);
  }
}
