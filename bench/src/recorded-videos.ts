/** The videos of `pnpm bench recording`: the cameras that are recorded, and what the file has of them. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { scrape } from './link-run.ts';

/** Each of the cameras. */
export const CAMERA = { width: 640, height: 480, framesPerS: 30, kbitPerS: 1500 } as const;
const PATTERNS = ['pinwheel', 'ball', 'smpte'] as const;

/** Options of a robot with this many cameras of test pictures. @param folder where its configuration is put */
export function videoArgs(folder: string, count: number, encoder: string): string[] {
  const { width, height, framesPerS } = CAMERA;
  const videos = Array.from({ length: count }, (_, i) => {
    const pattern = PATTERNS[i % PATTERNS.length];
    return {
      name: nameOf(i),
      source: { kind: 'test', pattern, width, height, framesPerS },
      encoder,
      ...CAMERA,
    };
  });
  const path = join(folder, 'farpoint.yaml');
  // JSON is valid YAML.
  writeFileSync(path, JSON.stringify({ robot: { videos } }));
  return ['--config', path];
}

export const NOTHING_ENCODED: { skipped: number[] } = { skipped: [] };

/** Pictures that the encoders skipped so far, by camera. */
export async function encodedVideos(adminUrl: string): Promise<{ skipped: number[] }> {
  const counts = await scrape(adminUrl, 'farpoint_robot_video_frames_skipped_total', 'camera');
  const cameras = Object.keys(counts).length;
  return { skipped: Array.from({ length: cameras }, (_, i) => counts[nameOf(i)] ?? 0) };
}

/** A coded picture in the file: its capture time, ms, and its size. */
export interface RecordedFrame {
  ms: number;
  bytes: number;
}

export interface RecordedVideoFigures {
  frames: number;
  /** Pictures that the camera took between those in the file. */
  lost: number;
  /** 1 if none is lost. */
  keptShare: number;
  framesPerSecond: number;
  bytesPerSecond: number;
}

/** @param frames in order of time */
export function recordedVideo(frames: readonly RecordedFrame[], framesPerS: number): RecordedVideoFigures {
  const intervalMs = 1000 / framesPerS;
  let lost = 0;
  for (let i = 1; i < frames.length; i++) {
    const gapMs = (frames[i] as RecordedFrame).ms - (frames[i - 1] as RecordedFrame).ms;
    lost += Math.max(0, Math.round(gapMs / intervalMs) - 1);
  }
  const seconds = ((frames.at(-1)?.ms ?? 0) - (frames[0]?.ms ?? 0)) / 1000;
  const bytes = frames.reduce((sum, frame) => sum + frame.bytes, 0);
  const perSecond = (value: number, digits: number) => Number((value / (seconds || 1)).toFixed(digits));
  return {
    frames: frames.length,
    lost,
    keptShare: frames.length === 0 ? 0 : Number((frames.length / (frames.length + lost)).toFixed(4)),
    framesPerSecond: perSecond(frames.length - 1, 2),
    bytesPerSecond: perSecond(bytes, 0),
  };
}

function nameOf(index: number): string {
  return `Camera ${index + 1}`;
}
