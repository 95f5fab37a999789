/** Checks Node, memory, the socket buffers that the kernel allows, and the processor. */
import { Simulation } from '@farpoint/sim';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { OrganisedFrameEncoder } from '../../sense/encode/organised-frame-encoder.ts';
import { fail, ok, type Result, warn } from './finding.ts';
import { type Host, megabytes, readNumber } from './host.ts';

export interface Load {
  cores: number;
  model: string;
  /** Load average of the last minute: programs that ran or were ready to. */
  load: number;
}

/** Above it processors are slowed down soon, °C. Chosen: most begin at 95 to 105, boards at 80 to 85. */
const HOT_CELSIUS = 85;
const CPU = '/sys/devices/system/cpu';

/** Checks cores, their governor and temperature, and the codec's speed on them. */
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

/**
 * Frames that are timed; their median counts. Chosen: the first ones compile, and the check stays under a
 * second or two.
 */
const FRAMES = 12;
/** Side of the frames, pixels: the simulated depth camera's own. */
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

/** The first version that runs TypeScript directly. */
const LEAST_NODE = [22, 18] as const;
const TESTED_NODE = 24;

/** @param version as `process.versions.node` */
export function checkNode(version: string, platform: string, architecture: string): Result[] {
  const [major = 0, minor = 0] = version.split('.').map(Number);
  const what = `Node ${version} on ${platform} ${architecture}`;
  const [leastMajor, leastMinor] = LEAST_NODE;
  if (major < leastMajor || (major === leastMajor && minor < leastMinor))
    return [
      fail(
        what,
        `Node ${LEAST_NODE.join('.')} or newer is needed; Node ${TESTED_NODE} is the tested version`,
      ),
    ];
  if (major < TESTED_NODE) return [warn(what, `Node ${TESTED_NODE} is the tested version`)];
  return [ok(what)];
}

/**
 * Less free memory than the first is a fault, less than the second is told, bytes. Chosen: below the first,
 * the system may end the program while it drives.
 */
const LEAST_MEMORY = 128e6;
const EASY_MEMORY = 512e6;

export function checkMemory(host: Host): Result[] {
  const available =
    Number(/^MemAvailable:\s+(\d+) kB/m.exec(host.read('/proc/meminfo') ?? '')?.[1] ?? Number.NaN) * 1024;
  if (Number.isNaN(available)) return [warn('free memory cannot be read', 'make sure that 512 MB are free')];
  const limit = readNumber(host, '/sys/fs/cgroup/memory.max');
  const used = readNumber(host, '/sys/fs/cgroup/memory.current') ?? 0;
  const limited = limit !== null && limit - used < available;
  const free = limited ? limit - used : available;
  const what = `${megabytes(free)} free${limited ? ` of the ${megabytes(limit)} that this container or unit may use` : ''}`;
  if (free < LEAST_MEMORY)
    return [fail(what, 'end other programs, or raise the limit: the robot needs at least 128 MB')];
  if (free < EASY_MEMORY) return [warn(what, 'large clouds and recordings need 512 MB or more')];
  return [ok(what)];
}

/** The receive buffer that media sockets request, bytes. */
const WANTED_RECEIVE = 2 * 1024 * 1024;
/** ROS 2's clouds and pictures come in bursts of a megabyte and more. */
const WANTED_RECEIVE_DDS = 8 * 1024 * 1024;
/** Linux's default, bytes: some 15 ms of a 60 Mbit/s stream. */
const WANTED_SEND = 212_992;

/** @param dds whether clouds come through DDS */
export function checkSocketBuffers(host: Host, dds: boolean): Result[] {
  const receive = readNumber(host, '/proc/sys/net/core/rmem_max');
  const send = readNumber(host, '/proc/sys/net/core/wmem_default');
  if (receive === null || send === null)
    return [
      warn('net.core.rmem_max and wmem_default cannot be read', 'in a container, check them on its host'),
    ];
  const wanted = dds ? WANTED_RECEIVE_DDS : WANTED_RECEIVE;
  const what = `receive up to ${receive} bytes, send ${send}`;
  const settings = [
    ...(receive < wanted ? [`net.core.rmem_max=${wanted}`] : []),
    ...(send < WANTED_SEND ? [`net.core.wmem_default=${WANTED_SEND}`] : []),
  ];
  if (settings.length === 0) return [ok(what)];
  return [
    warn(what, `bursts may be lost: \`sysctl -w ${settings.join(' ')}\`, and the same in /etc/sysctl.d`),
  ];
}
