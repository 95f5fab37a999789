/** Finds out which parts of ROS 2 are available, and which kind of graph to use. */
import { createRequire } from 'node:module';
import { RosFault } from '../fault.ts';

export type Environment = Readonly<Record<string, string | undefined>>;

/** How to join a ROS 2 graph: with DDS alone, or with rclnodejs and the sourced ROS installation. */
export type Ros2Graph = 'dds' | 'rclnodejs';

const WITHOUT = 'set ros.graph: dds, which needs no ROS';

/** Whether a ROS 2 installation is sourced. */
export function isSourced(env: Environment): boolean {
  return (env.AMENT_PREFIX_PATH ?? '') !== '' && (env.ROS_DISTRO ?? '') !== '';
}

/**
 * Entry point of rclnodejs, next to this package or along `NODE_PATH`; `null` if it is not installed. Runs none of its
 * code.
 */
export function findRclnodejs(): string | null {
  try {
    return createRequire(import.meta.url).resolve('rclnodejs');
  } catch {
    return null;
  }
}

/**
 * @param needsDds an option was given that only DDS alone supports
 * @throws {RosFault} `unavailable`: it was chosen by name, and something is missing
 */
export function chooseRos2Graph(
  asked: Ros2Graph | 'auto',
  { sourced, installed, needsDds }: { sourced: boolean; installed: boolean; needsDds: boolean },
): Ros2Graph {
  if (asked === 'auto') return sourced && installed && !needsDds ? 'rclnodejs' : 'dds';
  if (asked === 'dds') return 'dds';
  if (!sourced) {
    throw new RosFault('unavailable', 'no ROS 2 installation is sourced (AMENT_PREFIX_PATH, ROS_DISTRO)', {
      remedy: `source its setup.bash before the robot starts, or ${WITHOUT}`,
    });
  }
  if (!installed) {
    throw new RosFault('unavailable', 'rclnodejs is not installed', {
      remedy: `with ROS sourced, run \`npm install rclnodejs\` in a folder and add its node_modules to NODE_PATH; or ${WITHOUT}`,
    });
  }
  if (needsDds) {
    throw new RosFault('unavailable', 'rclnodejs cannot be given a network interface', {
      remedy: `configure ROS’s own middleware and remove ros.interface, or ${WITHOUT}`,
    });
  }
  return 'rclnodejs';
}

/** Absent options follow ROS's own variables. */
export interface RclOptions {
  domain?: number | undefined;
  peers?: readonly string[] | undefined;
  /** Only nodes on this machine. */
  localhostOnly?: boolean | undefined;
}

/** What ROS, its middleware and Node need of our environment. Everything else stays here: it may hold tokens. */
const NAMES: ReadonlySet<string> = new Set([
  'PATH',
  'HOME',
  'USER',
  'LOGNAME',
  'SHELL',
  'LANG',
  'LANGUAGE',
  'TZ',
  'TMPDIR',
  'HOSTNAME',
  'LD_LIBRARY_PATH',
  'LD_PRELOAD',
  'PYTHONPATH',
  'NODE_PATH',
  'CYCLONEDDS_URI',
  'CMAKE_PREFIX_PATH',
]);
const BEGINNINGS: readonly string[] = [
  'LC_',
  'XDG_',
  'ROS_',
  'RMW_',
  'RCL_',
  'RCUTILS_',
  'AMENT_',
  'COLCON_',
  'RCLNODEJS_',
  'CYCLONEDDS_',
  'FASTRTPS_',
  'FASTDDS_',
  'ZENOH_',
  'NDDS',
  'CONNEXTDDS_',
  'IGN_',
  'GZ_',
  'ICEORYX_',
];
/** Names that say that the value is a secret, whatever they begin with. */
const SECRET = /token|secret|passw|credential|api_?key/i;

function isOfRos(name: string): boolean {
  if (SECRET.test(name)) return false;
  return NAMES.has(name) || BEGINNINGS.some((beginning) => name.startsWith(beginning));
}

/**
 * The environment of a process that uses rcl: options become ROS's variables, and systemd's variables for this service
 * are removed.
 */
export function rclEnvironment({ domain, peers, localhostOnly }: RclOptions, env: Environment): Environment {
  const passed = Object.entries(env).filter(([name]) => isOfRos(name));
  // ROS_AUTOMATIC_DISCOVERY_RANGE came with Iron; later versions warn about the older variable.
  const reach =
    localhostOnly === undefined
      ? {}
      : env.ROS_DISTRO === 'humble'
        ? { ROS_LOCALHOST_ONLY: localhostOnly ? '1' : '0' }
        : { ROS_AUTOMATIC_DISCOVERY_RANGE: localhostOnly ? 'LOCALHOST' : 'SUBNET' };
  return {
    ...Object.fromEntries(passed),
    ...(domain === undefined ? {} : { ROS_DOMAIN_ID: String(domain) }),
    ...(peers === undefined ? {} : { ROS_STATIC_PEERS: peers.join(';') }),
    ...reach,
  };
}
