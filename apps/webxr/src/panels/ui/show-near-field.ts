/** Shows what is near the robot wherever the operator looks: on the floor, on the flat page, at the edge of the view. */
import type { RobotClient } from '@farpoint/operator';
import type { ReadonlySignal } from '@preact/signals-core';
import { blockedBearing } from '../../ground/near-field/blocked-bearing.ts';
import { nearView } from '../../ground/near-field/near-view.ts';
import { BlockedArc } from '../../scene/view/blocked-edge.ts';
import type { Stage } from '../../scene/view/stage.ts';
import { isRobotHeard } from '../../state/link-state.ts';
import { NearPicture, showBlockedEdge } from './near-panel.ts';

export class NearFieldDisplay {
  readonly #client: RobotClient;
  readonly #stage: Stage;
  readonly #inVr: ReadonlySignal<boolean>;
  readonly #picture = new NearPicture();
  readonly #arc: BlockedArc;
  /** Where the view's edge is red: radians counter-clockwise from up; `null`: nowhere. */
  blocked: number | null = null;

  constructor(client: RobotClient, stage: Stage, inVr: ReadonlySignal<boolean>) {
    this.#client = client;
    this.#stage = stage;
    this.#inVr = inVr;
    this.#arc = new BlockedArc(stage.camera);
  }

  /** Shows what is near, and what blocks. Call this at the rate of the commands. @param nowMs page's clock */
  update(nowMs: number): void {
    const { link, driver } = this.#client;
    const { session, phase } = link;
    const live = phase === 'live';
    const view = live
      ? nearView(session.near, {
          nowMs,
          offsetMs: session.clock.offsetMs,
          heard: isRobotHeard(link, nowMs),
        })
      : null;
    const body = (live ? session.welcome?.body : null) ?? null;
    this.#stage.near.body = body;
    this.#stage.near.show(view);
    this.#picture.show(body, view);
    const asked = live && !session.estop.latched ? driver.stream.asked : null;
    const bearing = blockedBearing(asked, session.telemetry?.motion);
    this.blocked = bearing === null ? null : this.#stage.onScreen(bearing);
    const inVr = this.#inVr.value;
    showBlockedEdge(inVr ? null : this.blocked);
    this.#arc.show(inVr ? this.blocked : null);
  }
}
