/** Times the same Rust code outside WASM: builds and runs the measuring example of the crate. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import type { OrganisedOptions, Pinhole } from '@farpoint/wasm-codec';
import type { BenchCloud } from './adapter.ts';

export interface NativeTimes {
  encodeMs: number;
  decodeMs: number;
}

const WORKSPACE = resolve(import.meta.dirname, '../../../wasm-codec');

/** @throws Error with the end of Cargo's output */
export function nativeUnorganised(cloud: BenchCloud, stepMm: number, rounds: number): NativeTimes {
  const attribute = cloud.attribute === 'colour' ? 'colour' : 'intensity8';
  return measured('farpoint-unorganised-codec', [points(cloud)], (file) => [
    file,
    `${stepMm}`,
    attribute,
    `${rounds}`,
  ]);
}

/** @throws Error with the end of Cargo's output */
export function nativeOrganised(
  cloud: BenchCloud,
  camera: Pinhole,
  { depthLevel = 3, colour = { quality: 18 }, budgetBytes }: OrganisedOptions,
  rounds: number,
): NativeTimes {
  const head = new ArrayBuffer(24);
  new Uint32Array(head, 0, 2).set([cloud.width, cloud.height]);
  new Float32Array(head, 8).set([camera.fx, camera.fy, camera.cx, camera.cy]);
  const mode = typeof colour === 'string' ? colour : colour.chroma === 'full' ? '444' : '420';
  const quality = typeof colour === 'string' ? [] : ['--quality', `${colour.quality}`];
  const budget = budgetBytes === undefined ? [] : ['--budget', `${budgetBytes}`];
  return measured('farpoint-organised-codec', [new Uint8Array(head), points(cloud)], (file) => [
    file,
    '--json',
    '--level',
    `${depthLevel}`,
    '--mode',
    mode,
    '--rounds',
    `${rounds}`,
    ...quality,
    ...budget,
  ]);
}

function points({ frame }: BenchCloud): Uint8Array {
  return new Uint8Array(frame.buffer, frame.byteOffset, frame.byteLength);
}

/** Builds and runs a crate's measuring example with a file made of these parts. */
function measured(
  crate: string,
  parts: readonly Uint8Array[],
  argumentsFor: (file: string) => string[],
): NativeTimes {
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-codec-'));
  try {
    const file = join(folder, 'points');
    writeFileSync(file, Buffer.concat(parts));
    const cargo = ['run', '--quiet', '--release', '-p', crate, '--example', 'measure', '--'];
    const result = spawnSync('cargo', [...cargo, ...argumentsFor(file)], {
      cwd: WORKSPACE,
      encoding: 'utf8',
    });
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
