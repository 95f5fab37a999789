/** The simulated robot's camera in `pnpm dev`: as video where that is possible, else as JPEG pictures. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { availableEncoders, chooseEncoder, VideoError, type VideoFailure } from '@farpoint/video';

/** Half the usual rate: two cores render and encode it beside all else (docs/video.md). */
const CAMERA = {
  name: 'Front',
  source: { kind: 'sim', width: 640, height: 480, framesPerS: 15 },
  framesPerS: 15,
  kbitPerS: 1000,
};

export interface DevVideo {
  /** The simulated robot's arguments for its camera: video, or else JPEG pictures. */
  readonly args: readonly string[];
  /** Why there is no video, and what to do about it; `null` if there is. */
  readonly without: string | null;
  /** Removes the robot's configuration file. */
  remove(): void;
}

/** @param program the program that encodes; by default the one that is built here */
export async function devVideo(program?: string): Promise<DevVideo> {
  const failure = await whyNone(program);
  if (failure !== null) {
    const { sentence, remedy } = failure;
    const without = `no camera video, JPEG pictures instead: ${sentence}; ${remedy}`;
    return { args: ['--pictures-of-cloud'], without, remove: () => undefined };
  }
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-dev-'));
  const file = join(folder, 'robot.json');
  writeFileSync(file, JSON.stringify({ robot: { videos: [CAMERA] } }));
  const remove = () => rmSync(folder, { recursive: true, force: true });
  return { args: ['--config', file], without: null, remove };
}

async function whyNone(program?: string): Promise<VideoFailure | null> {
  try {
    const { encoders } = await availableEncoders(program);
    const chosen = chooseEncoder(encoders, 'auto');
    return chosen.ok ? null : chosen.failure;
  } catch (error) {
    if (error instanceof VideoError) return error.failure;
    throw error;
  }
}
