/** What of the page's pictures and sound `window.farpoint` tells. */
import { opticalYaw } from '@farpoint/cloud-view';
import { LATENCY_TEST_COLOUR, SOUND_MEDIA, sequenceDelta32 } from '@farpoint/protocol';
import { Quaternion, Vector3 } from 'three';
import type { App } from '../page/app.ts';
import type {
  CameraProbe,
  DrawnProbe,
  FarpointTestApi,
  HeadsetProbe,
  SoundProbe,
  VideoProbe,
} from './test-api.ts';

type Probe =
  | 'probe'
  | 'wrist'
  | 'headset'
  | 'cameras'
  | 'sound'
  | 'videos'
  | 'robotNowMs'
  | 'videoCanvas'
  | 'sensors';

export function pageProbes(app: App): Pick<FarpointTestApi, Probe> {
  const { state, views } = app;
  return {
    probe: () => drawnProbe(app),
    wrist: () => app.wrist?.shown?.map(({ text, tone }) => ({ text, tone })) ?? null,
    headset: () => (app.vr.active.value ? headsetProbe(app) : null),
    cameras: () => cameraProbes(app),
    sound: () => soundProbe(app),
    videos: () => videoProbes(app),
    robotNowMs: () => robotNowMs(app),
    videoCanvas: (video) => state.videos.views.value[video]?.canvas ?? null,
    sensors: () =>
      state.sensors.all.value.map(({ index, name, on }) => ({
        name,
        wanted: on.value,
        points: views.clouds.drawnOf(index),
      })),
  };
}

/** The robot's clock as the page estimates it, ms; `null` until it is known. */
export function robotNowMs({ client }: App): number | null {
  const { offsetMs } = client.link.session.clock;
  return offsetMs === null ? null : performance.now() + offsetMs;
}

function cameraProbes({ state }: App): CameraProbe[] {
  return state.pictures.views.value.map(({ camera, canvas, newest, ageMs, failures }) => ({
    name: camera.name,
    shown: camera.on.value,
    width: canvas.width,
    height: canvas.height,
    ageMs: ageMs.value,
    pictures: newest.value?.number ?? 0,
    failures,
  }));
}

function videoProbes({ state, views }: App): VideoProbe[] {
  return state.videos.views.value.map(({ camera, canvas, newest, ageMs, fault }, video) => ({
    name: camera.name,
    codec: views.videos.codecOf(video),
    shown: camera.on.value,
    width: canvas.width,
    height: canvas.height,
    ageMs: ageMs.value,
    captureMs: views.videos.captureMs.get(video) ?? null,
    frames: newest.value?.number ?? 0,
    fault: fault.value,
    enlarged: state.enlarged.view.value?.canvas === canvas,
    fills: state.staged.view.value?.canvas === canvas,
  }));
}

function soundProbe(app: App): SoundProbe {
  const { heard, said, voice } = app.state.sound;
  return {
    heard: { state: heard.value.state, text: heard.value.text },
    said: { state: said.value.state, text: said.value.text },
    level: app.player.level(),
    peakHz: app.player.peakFrequency(),
    delayMs: soundDelayMs(app),
    sending: voice.value.sending,
  };
}

function soundDelayMs({ client }: App): number | null {
  const played = client.sound.played();
  const { offsetMs } = client.link.session.clock;
  if (played === null || offsetMs === null) return null;
  const ticksPerMs = SOUND_MEDIA.clockRate / 1000;
  const now = Math.floor((played.atMs + offsetMs) * ticksPerMs);
  return sequenceDelta32(now >>> 0, played.rtpTimestamp) / ticksPerMs;
}

function drawnProbe({ views: { cloud } }: App): DrawnProbe {
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

function headsetProbe({ stage, vr, sign, headset }: App): HeadsetProbe {
  const { view, passthrough, yaw, frontSide, darkness, model } = stage.headset;
  const eyes = stage.camera.getWorldPosition(new Vector3());
  const { x, y, z, scale } = model;
  return {
    view: view.value,
    frameRate: vr.frameRate,
    passthrough,
    yaw,
    frontSide,
    darkness,
    model: { x, y, z, scale },
    notice: sign?.shown ?? null,
    console: headset?.console?.shown ?? null,
    eyes: { x: -eyes.z, y: -eyes.x, z: eyes.y },
  };
}
