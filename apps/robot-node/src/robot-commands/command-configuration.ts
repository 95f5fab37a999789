import type { GraphOptions } from '../ros/open-graph.ts';

/** What the simulated robot does by itself. */
export const simActions = ['lights', 'horn', 'clear-faults'] as const;
export type SimAction = (typeof simActions)[number];

/** Publishes one message, which never changes. */
export interface PublishAction {
  kind: 'publish';
  topic: string;
  /** In ROS 2 notation. */
  type: string;
  /** The message, serialised for the robot's graph. */
  bytes: Uint8Array;
}

/** Calls a service of a ROS 1 graph. */
export interface CallAction {
  kind: 'call';
  service: string;
  type: 'std_srvs/Empty' | 'std_srvs/Trigger' | 'std_srvs/SetBool';
  /** Of std_srvs/SetBool. */
  data: boolean;
}

/** What operators do with recordings. */
export const recordActions = ['start', 'stop', 'bookmark'] as const;
export type RecordAction = (typeof recordActions)[number];

/** What a ROS graph does. */
export type GraphAction = PublishAction | CallAction;

export type CommandAction =
  | GraphAction
  | { kind: 'sim'; action: SimAction }
  | { kind: 'record'; action: RecordAction };

/** A command that operators may give, as configured. */
export interface CommandOptions {
  id: string;
  label: string;
  group?: string | undefined;
  /** It is to be given only after a second press. */
  confirm: boolean;
  /** Only who drives may give it; otherwise, every operator who may drive. */
  holdsLease: boolean;
  /** Also while the emergency stop is latched. */
  whileStopped: boolean;
  /** How often it may be given, by all operators together. */
  perSecond: number;
  /** Without an answer for so long, nobody waits for it any more, ms. */
  timeoutMs: number;
  action: CommandAction;
}

export interface CommandsConfiguration {
  commands: readonly CommandOptions[];
  /** `null`: no command needs one. */
  graph: GraphOptions | null;
}
