/** What `window.farpoint.state()` tells of the page. */
import { bodyYaw } from '@farpoint/cloud-view';
import type { Pose } from '@farpoint/protocol';
import { nearestHits } from '../ground/near-field/directions.ts';
import type { App } from '../page/app.ts';
import { nearDetails, nearWords } from '../words/near-words.ts';
import type { NearProbe, PageState } from './test-api.ts';

export function pageState(app: App): PageState {
  const { client, stage, state, views } = app;
  const { link, driver } = client;
  const { telemetry, estop } = link.session;
  const { position, rotation } = stage.rig;
  return {
    signaling: link.signaling,
    session: link.phase,
    sessionsOpened: link.sessionsOpened,
    lastLoss: link.lastLoss,
    robotId: link.robotId,
    robotListed: link.robotListed,
    link: state.link.line.value.text,
    notice: state.notices.last.value?.text ?? null,
    holder: driver.holder,
    estop: estop.latched,
    drive: telemetry?.drive ?? null,
    battery: telemetry?.battery?.percentage ?? null,
    body: telemetry === null ? null : flatPose(telemetry.pose),
    velocity:
      telemetry === null ? null : { linear: telemetry.twist.linear.x, angular: telemetry.twist.angular.z },
    driving: driver.stream.held && driver.holder === 'you',
    input: driver.input?.name ?? null,
    gripLost: driver.lost,
    path: stage.path.shown,
    near: nearProbe(app),
    navigation: { pathPoints: stage.plan.shown, mapCells: stage.floorMap.shown },
    model: stage.figures.shown,
    vr: app.vr.active.value,
    scene: { gridM: stage.grid.object.position.y, reachM: stage.look.reach },
    view: {
      x: -position.z,
      y: -position.x,
      z: position.y,
      yaw: rotation.y,
      ...views.predicted.figures,
    },
  };
}

function nearProbe({ state, stage, near }: App): NearProbe {
  const view = state.robot.near.value;
  return {
    hits: view === null ? [] : nearestHits(view.sectors),
    line: nearWords(view).text,
    details: nearDetails(view),
    ring: stage.near.shown,
    blocked: near.blocked,
  };
}

function flatPose({ position, orientation }: Pose): { x: number; y: number; z: number; yaw: number } {
  return { x: position.x, y: position.y, z: position.z, yaw: bodyYaw(orientation) };
}
