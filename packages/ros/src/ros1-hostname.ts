import { hostname } from 'node:os';

/** The name under which others reach this machine, determined as ROS 1's own nodes do. */
export function ros1Hostname(environment: NodeJS.ProcessEnv): string {
  return environment.ROS_HOSTNAME || environment.ROS_IP || hostname();
}
