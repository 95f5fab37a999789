/** What the page does again and again, whether frames are drawn or not: hands to the robot, and the state for people. */
import type { RobotClient } from '@farpoint/operator';
import type { CloudPanel } from '../panels/ui/cloud-panel.ts';
import type { EstopUi } from '../panels/ui/estop-ui.ts';
import type { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import type { NearFieldDisplay } from '../panels/ui/show-near-field.ts';
import type { VrSession } from '../scene/view/vr-session.ts';
import type { PageState } from '../state/page-state.ts';
import { AwayRelease } from '../take/drive/away-release.ts';
import type { PageStatistics } from '../words/page-stats.ts';
import type { FrameLoop } from './frame-loop.ts';
import type { PageViews } from './page-views.ts';

/**
 * As often as commands are sent (COMMANDS_PER_SECOND of the operator package: 40 a second), and as often as
 * people can read, ms.
 */
const DRIVE_EVERY_MS = 25;
const STATUS_EVERY_MS = 250;

export interface SteadyWorkParts {
  client: {
    driver: Pick<RobotClient['driver'], 'suspended' | 'letGo'>;
    update: RobotClient['update'];
  };
  inputs: Pick<OperatorInputs, 'poll'>;
  estop: Pick<EstopUi, 'update'>;
  cloudPanel: Pick<CloudPanel, 'update'>;
  near: Pick<NearFieldDisplay, 'update'>;
  vr: { active: Pick<VrSession['active'], 'value'>; hidden: boolean };
  state: {
    driving: { role: Pick<PageState['driving']['role'], 'value'> };
    looking: Pick<PageState['looking'], 'value'>;
    sample(): void;
    followSilence: PageState['followSilence'];
  };
  stats: Pick<PageStatistics, 'update' | 'remembered'>;
  views: {
    cloud: PageViews['cloud'];
    remembered: Pick<PageViews['remembered'], 'updateMap'>;
    videoColour: Pick<PageViews['videoColour'], 'update'>;
    videos: Pick<PageViews['videos'], 'measure'>;
  };
  frames: Pick<FrameLoop, 'measureGap' | 'govern'>;
  /** Draws the robot, its way and its plan where they are now. */
  showRobot(nowMs: number): void;
}

/** Where the page is: whether it is seen, and whether keys reach it. */
export interface PageAttention {
  readonly hidden: boolean;
  hasFocus(): boolean;
}

export class SteadyWork {
  readonly #parts: SteadyWorkParts;
  readonly #page: PageAttention;
  readonly #left = new AwayRelease();

  constructor(parts: SteadyWorkParts, page: PageAttention) {
    this.#parts = parts;
    this.#page = page;
  }

  start(): void {
    setInterval(() => this.drive(performance.now()), DRIVE_EVERY_MS);
    setInterval(() => this.report(performance.now()), STATUS_EVERY_MS);
  }

  /** Reads the hands, and sends what they want; nothing while the operator cannot see its effect. */
  drive(nowMs: number): void {
    const { frames, inputs, estop, client, state, vr, showRobot, near } = this.#parts;
    frames.measureGap(nowMs);
    inputs.poll(nowMs);
    const away = this.#handsAway();
    estop.update(nowMs, away);
    client.driver.suspended = away || state.driving.role.value === 'watch';
    if (this.#left.decide(vr.active.value ? vr.hidden : this.#page.hidden, nowMs)) client.driver.letGo(nowMs);
    client.update(nowMs);
    state.followSilence(nowMs);
    showRobot(nowMs);
    near.update(nowMs);
  }

  /** Brings figures and words up to date. */
  report(nowMs: number): void {
    const { stats, views, state, vr, cloudPanel, frames } = this.#parts;
    stats.update(views.cloud, nowMs);
    stats.remembered = views.remembered.updateMap(nowMs);
    views.videoColour.update(nowMs);
    views.videos.measure(nowMs);
    state.looking.value = vr.active.value || !this.#page.hidden;
    state.sample();
    cloudPanel.update();
    frames.govern(nowMs);
  }

  /** Commands may come only from an operator who can see their effect. */
  #handsAway(): boolean {
    const { vr } = this.#parts;
    if (vr.active.value) return vr.hidden;
    return this.#page.hidden || !this.#page.hasFocus();
  }
}
