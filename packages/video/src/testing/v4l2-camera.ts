/** A camera on USB, for tests on machines without one: see v4l2/camera.c. */
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const SOURCES = join(import.meta.dirname, 'v4l2');
const STREAM = 'stream';

/** Pictures that a program has taken, for their capture times. */
export interface TakenPicture {
  /** Of its grey, 0–255. */
  level: number;
  /** CLOCK_MONOTONIC. */
  takenNs: bigint;
}

export class V4l2Camera {
  readonly device = '/dev/farpoint-camera';
  readonly #folder = mkdtempSync(join(tmpdir(), 'farpoint-camera-'));
  readonly #log = join(this.#folder, 'log');
  readonly #unplugged = join(this.#folder, 'unplugged');
  /** More environment variables of the programs that shall see it. */
  readonly environment: Record<string, string>;

  static get suite(): { skip: boolean; note: string } {
    return { skip: spawnSync('cc', ['--version']).status !== 0, note: 'needs a C compiler (Debian: gcc)' };
  }

  /** Compiles it. */
  constructor() {
    const library = join(this.#folder, 'camera.so');
    const sources = readdirSync(SOURCES).filter((name) => name.endsWith('.c'));
    const flags = ['-std=gnu11', '-Wall', '-Wextra', '-Werror', '-O1', '-shared', '-fPIC', '-o', library];
    execFileSync('cc', [...flags, ...sources.map((name) => join(SOURCES, name)), '-ldl', '-lpthread']);
    const jpeg = join(this.#folder, 'picture.jpg');
    const pipeline = `videotestsrc num-buffers=1 ! video/x-raw,width=640,height=480 ! jpegenc ! filesink location=${jpeg}`;
    execFileSync('gst-launch-1.0', ['-q', ...pipeline.split(' ')]);
    this.environment = {
      LD_PRELOAD: library,
      FARPOINT_CAMERA_JPEG: jpeg,
      FARPOINT_CAMERA_LOG: this.#log,
      FARPOINT_CAMERA_UNPLUGGED: this.#unplugged,
    };
  }

  /** How often a program has begun a stream. */
  get streams(): number {
    return this.#lines.filter((line) => line === STREAM).length;
  }

  get taken(): TakenPicture[] {
    const pictures = this.#lines.filter((line) => line !== STREAM);
    return pictures.map((line) => {
      const [level, ns] = line.split(' ') as [string, string];
      return { level: Number(level), takenNs: BigInt(ns) };
    });
  }

  get #lines(): string[] {
    return readFileSync(this.#log, 'utf8').trimEnd().split('\n');
  }

  unplug(): void {
    writeFileSync(this.#unplugged, '');
  }

  plugIn(): void {
    rmSync(this.#unplugged, { force: true });
  }

  remove(): void {
    rmSync(this.#folder, { recursive: true, force: true });
  }
}
