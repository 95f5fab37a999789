/** What shows, in the scene, what the robot sends: clouds, videos, what was seen before, and where the robot is. */
import { CloudView } from '@farpoint/cloud-view';
import { CloudHold, driverHold, HeldClouds, noHold, type RobotClient } from '@farpoint/operator';
import type { Settings } from '../ground/settings.ts';
import { PresentedInstant } from '../ground/telemetry/presented-instant.ts';
import { RememberedWorld } from '../panels/ui/remembered-world.ts';
import type { PredictedView } from '../scene/view/predicted-view.ts';
import { SensorClouds } from '../scene/view/sensor-clouds.ts';
import type { Stage } from '../scene/view/stage.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import type { PageState } from '../state/page-state.ts';
import { VideoColour } from '../take/video/video-colour.ts';
import { VideoFeed } from '../take/video/video-feed.ts';
import type { VideoReceiver } from '../take/video/video-receiver.ts';
import { texts } from '../words/language.ts';

export interface PageViewsParts {
  readonly client: RobotClient;
  readonly settings: Settings;
  readonly stage: Stage;
  readonly state: PageState;
  readonly appearance: CloudAppearance;
  /** Leads the view by the operator's commands. Made before the clouds' views, which may release what it reads. */
  readonly predicted: PredictedView;
  /** `null` if this browser cannot read videos. */
  readonly receiver: VideoReceiver | null;
}

export class PageViews {
  /** Leads the view by the operator's commands. */
  readonly predicted: PredictedView;
  /** The capture instant of what is shown. */
  readonly presented = new PresentedInstant();
  /** Reads and presents the robot's videos. */
  readonly videos: VideoFeed;
  /** Clouds wait here for the videos that were captured with them. */
  readonly hold: CloudHold;
  readonly held: HeldClouds;
  readonly cloud: CloudView;
  /** What was seen before. */
  readonly remembered: RememberedWorld;
  /** The clouds of a robot with several sensors. */
  readonly clouds: SensorClouds;
  /** Paints clouds with the video of their camera. */
  readonly videoColour: VideoColour;

  constructor({ client, settings, stage, state, appearance, predicted, receiver }: PageViewsParts) {
    const { renderer, world } = stage;
    const { sensors, pointScale } = state;
    this.predicted = predicted;
    this.videos = new VideoFeed({
      client,
      views: state.videos,
      settings,
      receiver,
      words: texts().media.cannotShow,
      presented: this.presented,
      now: () => performance.now(),
      onShown: (captureMs) => client.seen.onShown(captureMs),
    });
    this.hold = new CloudHold((intervalMs) => (settings.synchronised ? driverHold : noHold)(intervalMs));
    this.held = new HeldClouds(client, this.hold, () => performance.now());
    const { held } = this;
    this.cloud = new CloudView(renderer, held);
    world.add(this.cloud);
    this.remembered = new RememberedWorld({ renderer, world, client, held });
    this.clouds = new SensorClouds({ renderer, world, client: held, first: this.cloud, sensors, pointScale });
    this.videoColour = new VideoColour({
      client,
      feed: this.videos,
      hold: this.hold,
      views: state.videos,
      clouds: this.clouds.all,
      wanted: appearance.paint,
      settings,
    });
  }
}
