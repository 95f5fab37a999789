/** What the page's surface (ui) sees of the page, and asks of it. */
import type { CloudView } from './cloud/cloud-view.ts';
import type { Driver } from './drive/driver.ts';
import type { LatencyProbe } from './latency/latency-probe.ts';
import type { PageLink } from './link/page-link.ts';
import type { Settings } from './settings.ts';
import type { PageStatistics } from './status/page-stats.ts';
import type { Stage } from './view/stage.ts';
import type { VrSession } from './view/vr-session.ts';

export interface PageParts {
  readonly settings: Settings;
  readonly stage: Stage;
  readonly cloud: CloudView;
  readonly link: PageLink;
  readonly driver: Driver;
  readonly stats: PageStatistics;
  readonly latency: LatencyProbe;
  readonly vr: VrSession;
  /** When points last came, page's clock, ms. */
  readonly lastPointsMs: number;
  /** The robot that is connected to, or will be once the present one stands. */
  readonly chosenRobotId: string | null;
  choose(robotId: string): void;
  leave(): void;
}
