import { hostname } from 'node:os';

/** How others reach this machine, found out as ROS 1's own nodes do. */
export function ros1Hostname(environment: NodeJS.ProcessEnv): string {
  return environment.ROS_HOSTNAME || environment.ROS_IP || hostname();
}
