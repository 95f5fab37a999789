/** A robot with cameras that are streamed as video. */
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { RobotSpec } from '@farpoint/local-stack';
import { availableEncoders } from '@farpoint/video';

export interface TestCamera {
  name: string;
  source: object;
  encoder: string;
  width?: number;
  height?: number;
  framesPerS?: number;
  kbitPerS?: number;
  ofCloud?: boolean;
}

/** Whether GStreamer and the program that encodes are there; without them, tests of videos are skipped. */
export const hasVideo = await availableEncoders().then(
  () => true,
  () => false,
);

/** Test pictures of a trigger's cameras: those with equal rates capture at the same instants. */
export function testCamera(name: string, encoder: string, more: Partial<TestCamera> = {}): TestCamera {
  const { width = 640, height = 480, framesPerS = 30 } = more;
  const source = { kind: 'test', width, height, framesPerS };
  return { name, source, encoder, width, height, framesPerS, kbitPerS: 800, ...more };
}

export function videoRobot(robot: RobotSpec, videos: readonly TestCamera[]): RobotSpec {
  const config = join(mkdtempSync(join(tmpdir(), 'farpoint-video-')), 'farpoint.yaml');
  writeFileSync(config, JSON.stringify({ robot: { videos } }));
  return { ...robot, args: [...(robot.args ?? []), '--config', config] };
}
