/** Helpers for this package's tests. */
import { spawnSync } from 'node:child_process';
import { ADDON_FILE } from '../build.ts';
import { VIDEO_ENCODERS, type VideoEncoder } from '../encoders.ts';
import { parseEncoders, type VideoPlaying, type VideoState, type VideoStats } from '../process-messages.ts';
import type { VideoFailure } from '../video-failure.ts';
import { VideoProcess, type VideoProcessOptions } from '../video-process.ts';
import type { EncodedFrame } from '../wire.ts';

/** Tests that need the program are skipped without it, and then name the command that builds it. */
export const VIDEO_SUITE = {
  skip: !isAvailable(),
  note: 'needs GStreamer and the program: docs/video.md; pnpm build:native video',
};

export function encoderNamed(name: string): VideoEncoder {
  return VIDEO_ENCODERS.find((each) => each.name === name)!;
}

export function nowMs(): number {
  return Number(process.hrtime.bigint()) / 1e6;
}

export function median(values: readonly number[]): number {
  return [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? Number.NaN;
}

/** A picture, and how old it was when it arrived. */
export interface Arrived extends EncodedFrame {
  readonly ageMs: number;
}

/** A process, what came from it, and waiting for more. */
export class Watched {
  readonly process: VideoProcess;
  readonly frames: Arrived[] = [];
  readonly states: VideoState[] = [];
  readonly failures: VideoFailure[] = [];
  #waiting: (() => void)[] = [];

  constructor(options: Omit<VideoProcessOptions, 'onFrame' | 'onFailure' | 'onState'>) {
    this.process = new VideoProcess({
      ...options,
      onFrame: (frame) => this.#add(this.frames, { ...frame, ageMs: nowMs() - frame.captureMs }),
      onState: (state) => this.#add(this.states, state),
      onFailure: (failure) => this.#add(this.failures, failure),
    });
  }

  /** Resolves once `is` returns true; it is asked again whenever something has come. */
  async until(is: () => boolean): Promise<void> {
    while (!is()) await new Promise<void>((resolve) => this.#waiting.push(resolve));
  }

  /** Resolves with the next so many pictures. */
  async next(count: number): Promise<Arrived[]> {
    const first = this.frames.length;
    await this.until(() => this.frames.length >= first + count);
    return this.frames.slice(first, first + count);
  }

  get stats(): VideoStats | undefined {
    return this.states.findLast((state) => state.state === 'stats');
  }

  get playing(): VideoPlaying | undefined {
    return this.states.findLast((state) => state.state === 'playing');
  }

  #add<T>(to: T[], item: T): void {
    to.push(item);
    const waiting = this.#waiting;
    this.#waiting = [];
    for (const each of waiting) each();
  }
}

/** The luma of the pictures in an H.264 stream, decoded by GStreamer: rows without gaps if the width divides by 4. */
export function decodeLuma(stream: Uint8Array, width: number, height: number): Uint8Array[] {
  const pipeline =
    'fdsrc fd=0 ! h264parse ! openh264dec ! videoconvert ! video/x-raw,format=GRAY8 ! fdsink fd=1';
  const { stdout } = spawnSync('gst-launch-1.0', ['-q', ...pipeline.split(' ')], {
    input: stream,
    maxBuffer: 256 * 1024 * 1024,
  });
  const size = width * height;
  return Array.from({ length: Math.floor(stdout.length / size) }, (_, i) =>
    stdout.subarray(i * size, (i + 1) * size),
  );
}

/** The 64 bits in a latency barcode, read without regard for its frame and checksum. */
export function barcodeTime(luma: Uint8Array, width: number): bigint {
  let time = 0n;
  for (let bit = 0; bit < 64; bit++) {
    const [row, column] = [1 + Math.floor(bit / 16), 1 + (bit % 16)];
    const middle = luma[(row * 8 + 4) * width + column * 8 + 4] ?? 0;
    time = (time << 1n) | (middle > 125 ? 1n : 0n);
  }
  return time;
}

function isAvailable(): boolean {
  const { status, stdout } = spawnSync(ADDON_FILE, ['--list-encoders']);
  if (status !== 0) return false;
  const names = parseEncoders(stdout).encoders.map(({ name }) => name);
  return names.includes('x264enc') && names.includes('vp8enc');
}
