/** The simulated robots of the tests with real programs. */
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { processFolder, type RobotSpec } from '@farpoint/local-stack';
import { ADDON_FILE } from '@farpoint/sound/build';
import { samplesOf } from '@farpoint/sound/testing';
import { availableEncoders } from '@farpoint/video';
import { AUDIO_RATE } from './voice.ts';

/** Whether GStreamer and the program that encodes are there; without them, tests of videos are skipped. */
export const hasVideo = await availableEncoders().then(
  () => true,
  () => false,
);
/** Whether the program for sound is built; without it, tests of sound are skipped. */
export const hasSound = existsSync(ADDON_FILE);
export const NEEDS_VIDEO = 'needs GStreamer and `pnpm build:native video`';
export const NEEDS_SOUND = 'needs GStreamer and `pnpm build:native sound`';

/** Its clouds are few and small: they leave the processor to the page, which draws in software. */
const lightRobot = {
  id: 'light',
  name: 'Light robot',
  args: ['--sim-seed', '1', '--mode', 'points64', '--max-points', '3000', '--sim-size', '96', '--fps', '10'],
} satisfies RobotSpec;

/** A light robot of this id. */
export function robotLike(id: string, ...args: string[]) {
  return { id, name: `Robot ${id}`, args: [...lightRobot.args, ...args] } satisfies RobotSpec;
}

/** It also offers the reference profile, for which there is the bridge. */
export const bridgedRobot = { ...robotLike('bridged'), reference: true } satisfies RobotSpec;

/** The whole of a depth camera's view, at a rate that a software renderer can follow. */
export const wholeRobot = {
  id: 'whole',
  name: 'Whole cloud',
  args: ['--source', 'sim', '--sim-seed', '1', '--fps', '8', '--start-mbps', '20', '--bitrate-mbps', '30'],
} satisfies RobotSpec;

const FRAMES = { width: 320, height: 240, framesPerS: 15 };

/** A camera with a test picture: those with equal rates capture at the same instants. */
export function testCamera(name: string, encoder: string, pattern: string) {
  return { name, encoder, ...FRAMES, kbitPerS: 400, source: { kind: 'test', pattern, ...FRAMES } };
}

export interface MediaRobot {
  readonly spec: RobotSpec;
  /** What its loudspeaker has played, {@link AUDIO_RATE} samples a second. */
  heard(): Int16Array;
}

/** A robot with two cameras, of which one is H.264 only, a microphone that hears a tone of 600 Hz, and a loudspeaker. */
export function mediaRobot(): MediaRobot {
  const folder = processFolder();
  const file = join(folder, 'heard.raw');
  const played = `audio/x-raw,format=S16LE,rate=${AUDIO_RATE},channels=1`;
  const pipeline = `${played} ! filesink location=${file} buffer-mode=unbuffered`;
  const sound = {
    microphone: { source: { kind: 'test', frequency: 600 } },
    loudspeaker: { sink: { kind: 'gst', pipeline } },
  };
  const videos = [testCamera('Front', 'auto', 'pinwheel'), testCamera('Rear', 'h264', 'ball')];
  const config = join(folder, 'farpoint.yaml');
  const robot = { ...(hasVideo ? { videos } : {}), ...(hasSound ? { sound } : {}) };
  // JSON is valid YAML.
  writeFileSync(config, JSON.stringify({ robot }));
  return {
    spec: robotLike('media', '--config', config),
    heard: () => (existsSync(file) ? samplesOf(readFileSync(file)) : new Int16Array(0)),
  };
}
