/** Puts {@link FarpointTestApi} on the window. */

import { bodyYaw, opticalYaw } from '@farpoint/cloud-view';
import { LATENCY_TEST_COLOUR, type Pose, SOUND_MEDIA, sequenceDelta32 } from '@farpoint/protocol';
import { Quaternion, Vector3 } from 'three';
import { nearestHits } from '../ground/near-field/directions.ts';
import type { App } from '../page/app.ts';
import { nearDetails, nearWords } from '../words/near-words.ts';
import { DriveRecord } from './drive-record.ts';
import { PacketRecord } from './packet-record.ts';
import { PresentationRecord } from './presentation-record.ts';
import { ScriptInput } from './script-input.ts';
import type { DrawnProbe, FarpointTestApi, HeadsetProbe, NearProbe } from './test-api.ts';

/** A grip that nobody renews lets go by itself. */
const LONGEST_HOLD_MS = 60_000;

export function installTestApi(app: App): void {
  const { client, stage } = app;
  const { cloud } = app.views;
  const { link, driver } = client;
  const script = new ScriptInput();
  driver.add(script);
  let release: ReturnType<typeof setTimeout> | undefined;
  let packets: PacketRecord | null = null;
  let presentations: PresentationRecord | null = null;
  let drive: DriveRecord | null = null;
  const robotNowMs = () => {
    const { offsetMs } = app.client.link.session.clock;
    return offsetMs === null ? null : performance.now() + offsetMs;
  };
  const soundDelayMs = () => {
    const played = client.sound.played();
    const { offsetMs } = link.session.clock;
    if (played === null || offsetMs === null) return null;
    const ticksPerMs = SOUND_MEDIA.clockRate / 1000;
    const now = Math.floor((played.atMs + offsetMs) * ticksPerMs);
    return sequenceDelta32(now >>> 0, played.rtpTimestamp) / ticksPerMs;
  };
  client.on('cloud', (batch) => packets?.add(batch, performance.timeOrigin));
  const api: FarpointTestApi = {
    version: 1,
    state() {
      const { telemetry, estop } = link.session;
      return {
        signaling: link.signaling,
        session: link.phase,
        sessionsOpened: link.sessionsOpened,
        lastLoss: link.lastLoss,
        robotId: link.robotId,
        robotListed: link.robotListed,
        link: app.state.link.line.value.text,
        notice: app.state.notices.last.value?.text ?? null,
        holder: driver.holder,
        estop: estop.latched,
        drive: telemetry?.drive ?? null,
        battery: telemetry?.battery?.percentage ?? null,
        body: telemetry === null ? null : flatPose(telemetry.pose),
        velocity:
          telemetry === null
            ? null
            : { linear: telemetry.twist.linear.x, angular: telemetry.twist.angular.z },
        driving: driver.stream.held && driver.holder === 'you',
        input: driver.input?.name ?? null,
        gripLost: driver.lost,
        path: app.stage.path.shown,
        near: nearProbe(app),
        navigation: { pathPoints: stage.plan.shown, mapCells: stage.floorMap.shown },
        model: stage.figures.shown,
        vr: app.vr.active.value,
        scene: { gridM: stage.grid.object.position.y, reachM: stage.look.reach },
        view: {
          ...{ x: -stage.rig.position.z, y: -stage.rig.position.x, z: stage.rig.position.y },
          ...{ yaw: stage.rig.rotation.y, ...app.views.predicted.figures },
        },
      };
    },
    stats: () => app.figures(),
    resetStats: () => {
      client.statistics.resetDistributions();
      app.stats.resetDistributions();
      app.views.videos.resetDistributions();
    },
    robots: () => link.robots,
    connect(robotId, timeoutMs = 30_000) {
      app.choose(robotId);
      const stands = () => link.robotId === robotId && link.phase === 'live' && cloud.hasPoints;
      return until(stands, timeoutMs, `no session with ${robotId}`);
    },
    disconnect: () => client.leave(),
    requestLease: (take = false) => driver.requestLease(take),
    estop: (latch) => void (latch ? client.estop() : client.releaseEstop()),
    latencyTest: () => client.latencyTest(),
    latencyResults: () => client.statistics.results,
    async drive(wish, ms) {
      script.hold(wish);
      driver.tick(performance.now());
      await new Promise((resolve) => setTimeout(resolve, ms));
      script.release();
      driver.tick(performance.now());
    },
    hold(wish) {
      clearTimeout(release);
      script.release();
      if (wish !== null) {
        script.hold(wish);
        release = setTimeout(() => script.release(), LONGEST_HOLD_MS);
      }
      driver.tick(performance.now());
    },
    shareLink: ({ cloud, videos }) => client.shareLink(cloud, videos),
    probe: () => probe(app),
    wrist: () => app.wrist?.shown?.map(({ text, tone }) => ({ text, tone })) ?? null,
    headset: () => (app.vr.active.value ? headsetProbe(app) : null),
    cameras: () =>
      app.state.pictures.views.value.map(({ camera, canvas, newest, ageMs, failures }) => ({
        ...{ name: camera.name, shown: camera.on.value, width: canvas.width, height: canvas.height },
        ...{ ageMs: ageMs.value, pictures: newest.value?.number ?? 0, failures },
      })),
    sound() {
      const { heard, said, voice } = app.state.sound;
      return {
        heard: { state: heard.value.state, text: heard.value.text },
        said: { state: said.value.state, text: said.value.text },
        level: app.player.level(),
        peakHz: app.player.peakFrequency(),
        delayMs: soundDelayMs(),
        sending: voice.value.sending,
      };
    },
    videos: () =>
      app.state.videos.views.value.map(({ camera, canvas, newest, ageMs, fault }, video) => ({
        codec: app.views.videos.codecOf(video),
        ...{ name: camera.name, shown: camera.on.value, width: canvas.width, height: canvas.height },
        ...{ ageMs: ageMs.value, frames: newest.value?.number ?? 0, fault: fault.value },
        captureMs: app.views.videos.captureMs.get(video) ?? null,
        enlarged: app.state.enlarged.view.value?.canvas === canvas,
        fills: app.state.staged.view.value?.canvas === canvas,
      })),
    robotNowMs,
    recordPresentations(capacity) {
      const record = capacity === null ? null : new PresentationRecord(capacity, robotNowMs);
      presentations = record;
      app.views.videos.onPresented =
        record === null
          ? null
          : () =>
              record.add(
                app.state.videos.views.value.map(({ canvas }) => canvas),
                () => app.views.hold.passedMs,
              );
    },
    recordedPresentations: () => [...(presentations?.rows ?? [])],
    videoCanvas: (video) => app.state.videos.views.value[video]?.canvas ?? null,
    sensors: () =>
      app.state.sensors.all.value.map(({ index, name, on }) => ({
        ...{ name, wanted: on.value, points: app.views.clouds.drawnOf(index) },
      })),
    recordPackets(capacity) {
      packets = capacity === null ? null : new PacketRecord(capacity);
    },
    recordedPackets() {
      const { clock } = link.session;
      const values = [...(packets?.values ?? [])];
      for (let i = 2; i < values.length; i += 3)
        values[i] = (values[i] as number) + (clock.offsetMs ?? Number.NaN);
      return { values, minRttMs: clock.minRttMs };
    },
    recordDrive(on) {
      drive?.stop();
      if (on) drive = new DriveRecord(client);
    },
    recordedDrive: () =>
      drive === null ? null : { rows: drive.rows, gripsLost: drive.gripsLost, refusals: drive.refusals },
  };
  window.farpoint = api;
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

function probe({ views: { cloud } }: App): DrawnProbe {
  const { points, slots } = cloud.readBack();
  const poses = [0, 1].map((slot) => {
    const { unit, position, orientation } = cloud.pose(slot);
    return {
      unit,
      position: new Vector3(position.x, position.y, position.z),
      orientation: new Quaternion(orientation.x, orientation.y, orientation.z, orientation.w),
    };
  });
  const min = new Vector3(1, 1, 1).multiplyScalar(Number.POSITIVE_INFINITY);
  const max = min.clone().negate();
  const point = new Vector3();
  let count = 0;
  let green = 0;
  for (const [index, slot] of slots.entries()) {
    if (slot === null) continue;
    count++;
    if ((points[index * 4 + 3] as number) === LATENCY_TEST_COLOUR) green++;
    point.fromArray(points, index * 4).multiplyScalar(poses[slot]!.unit);
    point.applyQuaternion(poses[slot]!.orientation).add(poses[slot]!.position);
    min.min(point);
    max.max(point);
  }
  const { x, y, z } = cloud.cameraPosition;
  return {
    surface: cloud.isSurface,
    points: cloud.isSurface ? cloud.drawn : count,
    green,
    bounds: count === 0 ? null : { min: min.toArray(), max: max.toArray() },
    camera: cloud.hasPoints ? { x, y, z, yaw: opticalYaw(cloud.cameraOrientation, 0) } : null,
  };
}

function headsetProbe({ stage, vr }: App): HeadsetProbe {
  const { view, passthrough, yaw, frontSide, darkness, model } = stage.headset;
  const eyes = stage.camera.getWorldPosition(new Vector3());
  const { x, y, z, scale } = model;
  return {
    ...{ view: view.value, frameRate: vr.frameRate },
    ...{ passthrough, yaw, frontSide, darkness, model: { x, y, z, scale } },
    eyes: { x: -eyes.z, y: -eyes.x, z: eyes.y },
  };
}

function flatPose({ position, orientation }: Pose): { x: number; y: number; z: number; yaw: number } {
  return { x: position.x, y: position.y, z: position.z, yaw: bodyYaw(orientation) };
}

function until(condition: () => boolean, timeoutMs: number, failure: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const began = performance.now();
    const timer = setInterval(() => {
      if (condition()) {
        clearInterval(timer);
        resolve();
      } else if (performance.now() - began > timeoutMs) {
        clearInterval(timer);
        reject(new Error(`${failure} within ${timeoutMs} ms`));
      }
    }, 20);
  });
}
