/** Checks cores, their governor and temperature, and the codec's speed on them. */
import { Simulation } from '@farpoint/sim';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { OrganisedFrameEncoder } from '../../sense/encode/organised-frame-encoder.ts';
import { fail, ok, type Result, warn } from './finding.ts';
import { type Host, readNumber } from './host.ts';

export interface Load {
  cores: number;
  model: string;
  /** Load average of the last minute: programs that ran or were ready to. */
  load: number;
}

const HOT_CELSIUS = 85;
const CPU = '/sys/devices/system/cpu';

export function checkProcessor(host: Host, { cores, model, load }: Load): Result[] {
  const results: Result[] = [];
  const quota = cpuQuota(host);
  const usable = Math.min(cores, quota ?? cores);
  const limited = usable < cores ? `, of which this container or unit may use ${usable.toFixed(1)}` : '';
  const what = `${cores} cores (${model})${limited}, load ${load.toFixed(1)}`;
  if (usable < 2) results.push(warn(what, 'use two cores or more: capturing and sending run in parallel'));
  else if (load > cores) results.push(warn(what, 'the load exceeds the cores: end other programs'));
  else results.push(ok(what));

  const slow = slowGovernors(host);
  if (slow.length > 0)
    results.push(
      warn(
        `frequency governor ${slow.join(', ')}`,
        '`cpupower frequency-set -g performance`, on a Jetson `nvpmodel -m 0 && jetson_clocks`',
      ),
    );
  results.push(...checkHeat(host));
  return results;
}

/** Number of cores that the control group allows; `null` without a limit. */
function cpuQuota(host: Host): number | null {
  const [quota, period] = (host.read('/sys/fs/cgroup/cpu.max') ?? '').split(' ').map(Number);
  return quota !== undefined && period !== undefined && quota > 0 && period > 0 ? quota / period : null;
}

/** Governors that keep a core slow. Drivers that choose the frequency themselves also call theirs `powersave`. */
function slowGovernors(host: Host): string[] {
  const found = new Set<string>();
  for (const name of host.list(CPU)) {
    if (!/^cpu\d+$/.test(name)) continue;
    const governor = host.read(`${CPU}/${name}/cpufreq/scaling_governor`);
    const driver = host.read(`${CPU}/${name}/cpufreq/scaling_driver`) ?? '';
    if (governor === 'powersave' && !/pstate/.test(driver)) found.add(governor);
  }
  return [...found];
}

function checkHeat(host: Host): Result[] {
  const throttled = host
    .list(CPU)
    .filter((name) => /^cpu\d+$/.test(name))
    .reduce(
      (sum, name) => sum + (readNumber(host, `${CPU}/${name}/thermal_throttle/core_throttle_count`) ?? 0),
      0,
    );
  const zones = host
    .list('/sys/class/thermal')
    .filter((name) => name.startsWith('thermal_zone'))
    .map((name) => readNumber(host, `/sys/class/thermal/${name}/temp`))
    .filter((milli) => milli !== null);
  const hottest = zones.length === 0 ? null : Math.max(...zones) / 1000;
  // A Raspberry Pi's firmware: bits 0–3 are the present state, bits 16–19 the state since boot.
  const firmware = Number.parseInt(
    host.read('/sys/devices/platform/soc/soc:firmware/get_throttled') ?? '0',
    16,
  );
  const remedy = 'improve cooling or power: a throttled core encodes fewer frames';
  const results: Result[] = [];
  if (firmware > 0) results.push(warn(`the firmware has throttled (0x${firmware.toString(16)})`, remedy));
  if (throttled > 0) results.push(warn(`throttled by heat ${throttled} times since the start`, remedy));
  if (hottest !== null)
    results.push(
      hottest >= HOT_CELSIUS
        ? warn(`${hottest.toFixed(0)} °C`, remedy)
        : ok(`${hottest.toFixed(0)} °C at most`),
    );
  return results;
}

const FRAMES = 12;
const SIZE = 480;
/** 24 Mbit/s at 30 frames a second. */
const BUDGET_BYTES = 100_000;

/** Encodes a few simulated frames as the robot would. */
export async function timeCodec(now: () => number): Promise<number[]> {
  const simulation = await Simulation.create({ seed: 1, camera: { width: SIZE, height: SIZE } });
  const { fx, fy, cx, cy } = simulation.intrinsics;
  const sampling = { lambda: 1, epsilon: 1e-6, nearDistance: 3.85, depthMeasure: 'z' as const, sensor: 0 };
  const encoder = new OrganisedFrameEncoder(
    await loadCodecFromDisk(),
    { width: SIZE, height: SIZE },
    sampling,
    now,
  );
  const times: number[] = [];
  for (let i = 0; i < FRAMES; i++) {
    simulation.setCommand({ linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.5 } });
    simulation.step(1 / 30);
    const { depth, colour, cameraPose } = simulation.renderFrame({ points: false });
    const words = new Uint32Array(colour.buffer, colour.byteOffset, depth.length);
    const frame = { form: 'images', depth, colour: words, cameraPose, capturedAtMs: now() } as const;
    const begin = now();
    encoder.take(frame, { fx, fy, cx, cy });
    encoder.encode(frame, i, BUDGET_BYTES, false);
    times.push(now() - begin);
  }
  simulation.close();
  return times;
}

/** @param times of the frames in order, ms; the first frames also warm up the machine */
export function judgeCodec(times: readonly number[]): Result[] {
  const warm = times.slice(times.length >> 1).sort((a, b) => a - b);
  const median = warm[warm.length >> 1] ?? Number.NaN;
  const what = `a frame of ${SIZE} × ${SIZE} points takes ${median.toFixed(1)} ms to encode`;
  const remedy =
    'use fewer pixels, fewer frames a second, or a faster processor; see frequency governor and temperature';
  if (!(median < 100)) return [fail(what, remedy)];
  return [median > 33 ? warn(what, remedy) : ok(what)];
}
