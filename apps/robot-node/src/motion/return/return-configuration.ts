import type { ReturnOptions } from '@farpoint/safety';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';

/** How the robot drives back by itself, as configured. */
export interface ReturnConfiguration {
  options: ReturnOptions;
  /** Where the robot says that it does; `null`: in no topic. */
  topic: { graph: GraphOptions; topic: string } | null;
}
