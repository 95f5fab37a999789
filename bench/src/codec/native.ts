/** Times of the same Rust code outside WASM: builds and runs the crate's own measuring example. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import type { BenchCloud } from './adapter.ts';

export interface NativeTimes {
  encodeMs: number;
  decodeMs: number;
}

const WORKSPACE = resolve(import.meta.dirname, '../../../wasm-codec');

/** @throws Error with Cargo's last words */
export function nativeUnorganised(cloud: BenchCloud, stepMm: number, rounds: number): NativeTimes {
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-codec-'));
  try {
    const file = join(folder, 'points');
    const { frame } = cloud;
    writeFileSync(file, new Uint8Array(frame.buffer, frame.byteOffset, frame.byteLength));
    const attribute = cloud.attribute === 'colour' ? 'colour' : 'intensity8';
    const example = ['-p', 'farpoint-unorganised-codec', '--example', 'measure'];
    const cargo = [
      'run',
      '--quiet',
      '--release',
      ...example,
      '--',
      file,
      `${stepMm}`,
      attribute,
      `${rounds}`,
    ];
    const result = spawnSync('cargo', cargo, { cwd: WORKSPACE, encoding: 'utf8' });
    if (result.error !== undefined) throw new Error(`cargo: ${result.error.message}`);
    if (result.status !== 0) throw new Error(`cargo: ${result.stderr.trim().slice(-300)}`);
    const times = JSON.parse(result.stdout) as Partial<Record<string, unknown>>;
    const { encodeMs, decodeMs } = times;
    if (typeof encodeMs !== 'number' || typeof decodeMs !== 'number') {
      throw new Error(`not times: ${result.stdout.slice(0, 100)}`);
    }
    return { encodeMs, decodeMs };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
