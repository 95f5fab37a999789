/** Runs PyPI's readers and writers of recordings, in a virtual environment that is created once. */
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, renameSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import * as z from 'zod';

const PACKAGES = [
  ...['mcap==1.6.0', 'mcap-ros2-support==0.6.0', 'rosbags==0.11.9', 'numpy==2.4.6', 'lz4==4.4.5'],
  ...['foxglove-schemas-protobuf==0.4.0', 'protobuf==7.36.2'],
];
const SCRIPT = join(import.meta.dirname, 'peers.py');

const contentSchema = z.object({
  topics: z.record(
    z.string(),
    z.object({
      type: z.string(),
      metadata: z.record(z.string(), z.string()),
      count: z.int(),
      sequence: z.int(),
      /** For each cloud: number of points, and the sums of x, y and z. */
      sums: z.array(z.tuple([z.number(), z.number(), z.number(), z.number()])),
      pictures: z.array(
        z.object({
          stampNs: z.string(),
          logNs: z.string(),
          frame: z.string(),
          format: z.string(),
          bytes: z.int(),
          sha256: z.string(),
        }),
      ),
      last: z.unknown().optional(),
    }),
  ),
  messages: z.int(),
  chunks: z.int(),
  profile: z.string(),
});
export type PeerContent = z.infer<typeof contentSchema>;

export class Peers {
  readonly #python: string;

  private constructor(python: string) {
    this.#python = python;
  }

  /** @returns the reason if they cannot be installed: no Python 3, no package index */
  static install(): Peers | string {
    const folder = join(
      tmpdir(),
      `farpoint-recording-peers-${PACKAGES.join('-').replace(/[^a-z0-9.]+/g, '-')}`,
    );
    const python = join(folder, 'bin', 'python');
    if (existsSync(python)) return new Peers(python);
    const making = mkdtempSync(join(tmpdir(), 'farpoint-recording-making-'));
    try {
      // Created under a temporary name and renamed, so that parallel tests see all of it or nothing.
      execFileSync('python3', ['-m', 'venv', making], { stdio: 'pipe', timeout: 120_000 });
      execFileSync(
        join(making, 'bin', 'python'),
        ['-m', 'pip', '-q', '--retries', '1', '--timeout', '10', 'install', ...PACKAGES],
        {
          stdio: 'pipe',
          timeout: 300_000,
        },
      );
      if (!existsSync(folder)) renameSync(making, folder);
      return new Peers(python);
    } catch (error) {
      return `PyPI’s mcap and rosbags cannot be installed: ${error instanceof Error ? error.message.split('\n')[0] : error}`;
    } finally {
      rmSync(making, { recursive: true, force: true });
    }
  }

  /** Writes the same drive in every format. */
  write(folder: string): void {
    mkdirSync(folder, { recursive: true });
    execFileSync(this.#python, [SCRIPT, 'write', folder], { stdio: ['ignore', 'pipe', 'inherit'] });
  }

  /** Writes clouds and pictures: `ros1.bag`, `ros1.mcap`, `ros2.mcap` and `foxglove.mcap`. */
  writePictures(folder: string): void {
    mkdirSync(folder, { recursive: true });
    execFileSync(this.#python, [SCRIPT, 'pictures', folder], { stdio: ['ignore', 'pipe', 'inherit'] });
  }

  /** Messages of each topic, as rosbags reads them. */
  count(file: string): Record<string, number> {
    const text = execFileSync(this.#python, [SCRIPT, 'count', file], {
      stdio: ['ignore', 'pipe', 'inherit'],
    });
    return z.record(z.string(), z.int()).parse(JSON.parse(text.toString()));
  }

  read(file: string): PeerContent {
    const text = execFileSync(this.#python, [SCRIPT, 'read', file], { stdio: ['ignore', 'pipe', 'inherit'] });
    return contentSchema.parse(JSON.parse(text.toString()));
  }
}
