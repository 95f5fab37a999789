import { hostname } from 'node:os';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { RobotOptionValues } from './robot-program.ts';
import { rosMasterUrl } from './ros.ts';

/** The robot's graph of this kind. */
export function toGraph(values: RobotOptionValues, kind: GraphOptions['kind']): GraphOptions {
  const { env } = process;
  // Characters that a node name may not contain become _.
  const name = values.rosName ?? `farpoint_${values.id.replaceAll(/[^A-Za-z0-9_]/g, '_')}`;
  if (kind === 'ros2') {
    const { rosDomain, rosInterface, rosPeers, rosReach } = values;
    return {
      kind,
      name,
      graph: values.rosGraph,
      ...(rosDomain === null ? {} : { domain: rosDomain }),
      ...(rosInterface === null ? {} : { interface: rosInterface }),
      ...(rosPeers.length === 0 ? {} : { peers: rosPeers }),
      ...(rosReach === null ? {} : { localhostOnly: rosReach === 'localhost' }),
    };
  }
  return {
    kind,
    name,
    masterUrl: rosMasterUrl(values.rosMaster, env),
    hostname: values.rosHostname ?? ros1Hostname(env),
  };
}

/** The name under which others reach this machine, determined as ROS 1's own nodes do. */
function ros1Hostname(environment: NodeJS.ProcessEnv): string {
  return environment.ROS_HOSTNAME || environment.ROS_IP || hostname();
}
