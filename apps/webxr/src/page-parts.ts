/** What the page's surface (ui) sees of the page, and asks of it. */
import type { CloudView } from '@farpoint/cloud-view';
import type { RobotClient } from '@farpoint/operator';
import type { Settings } from './settings.ts';
import type { PageStatistics } from './status/page-stats.ts';
import type { SensorClouds } from './view/sensor-clouds.ts';
import type { Stage } from './view/stage.ts';
import type { VrSession } from './view/vr-session.ts';

export interface PageParts {
  readonly settings: Settings;
  readonly stage: Stage;
  readonly cloud: CloudView;
  readonly clouds: SensorClouds;
  readonly client: RobotClient;
  readonly stats: PageStatistics;
  readonly vr: VrSession;
  choose(robotId: string): void;
}
