/** What of ROS 2 is there beside us, and which graph that makes. */
import { createRequire } from 'node:module';
import { RosFault } from '../fault.ts';

export type Environment = Readonly<Record<string, string | undefined>>;

/** How to take part in a ROS 2 graph: DDS by itself, or rclnodejs with the installation that is sourced. */
export type Ros2Graph = 'dds' | 'rclnodejs';

const WITHOUT = 'set ros.graph: dds, which needs no ROS';

/** Is a ROS 2 installation sourced? */
export function isSourced(env: Environment): boolean {
  return (env.AMENT_PREFIX_PATH ?? '') !== '' && (env.ROS_DISTRO ?? '') !== '';
}

/** Where rclnodejs begins, beside this package or along `NODE_PATH`; `null` where it is not installed. Nothing of it is run. */
export function findRclnodejs(): string | null {
  try {
    return createRequire(import.meta.url).resolve('rclnodejs');
  } catch {
    return null;
  }
}

/**
 * @param needsDds something is asked for that only DDS by itself can do
 * @throws {RosFault} `unavailable`: it was asked for by name, and something is missing
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

/** Left out: as ROS's own variables say. */
export interface RclOptions {
  domain?: number | undefined;
  peers?: readonly string[] | undefined;
  /** Nodes of this machine alone. */
  localhostOnly?: boolean | undefined;
}

/** The environment of a process that uses rcl: options become ROS's variables, and what systemd told us is ours alone. */
export function rclEnvironment({ domain, peers, localhostOnly }: RclOptions, env: Environment): Environment {
  const { NOTIFY_SOCKET: _, WATCHDOG_USEC: __, WATCHDOG_PID: ___, ...rest } = env;
  // ROS_AUTOMATIC_DISCOVERY_RANGE came with Iron; later ones warn of the older variable.
  const reach =
    localhostOnly === undefined
      ? {}
      : env.ROS_DISTRO === 'humble'
        ? { ROS_LOCALHOST_ONLY: localhostOnly ? '1' : '0' }
        : { ROS_AUTOMATIC_DISCOVERY_RANGE: localhostOnly ? 'LOCALHOST' : 'SUBNET' };
  return {
    ...rest,
    ...(domain === undefined ? {} : { ROS_DOMAIN_ID: String(domain) }),
    ...(peers === undefined ? {} : { ROS_STATIC_PEERS: peers.join(';') }),
    ...reach,
  };
}
