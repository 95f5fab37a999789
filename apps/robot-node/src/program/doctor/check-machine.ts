/** Checks Node, memory, and the socket buffers that the kernel allows. */
import { fail, ok, type Result, warn } from './finding.ts';
import { type Host, megabytes, readNumber } from './host.ts';

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
