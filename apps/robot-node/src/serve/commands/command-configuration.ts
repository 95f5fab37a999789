/** The commands that operators may give, as configured. */
import type { ServiceType } from '@farpoint/ros';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';

/** What the simulated robot does by itself. */
export const simActions = ['lights', 'horn', 'self-test'] as const;
export type SimAction = (typeof simActions)[number];

/** What operators do with recordings. */
export const recordActions = ['start', 'stop', 'bookmark'] as const;
export type RecordAction = (typeof recordActions)[number];

/** Who may give a command. */
export const commandGivers = [
  'watch', // everybody
  'drive', // every operator who may drive
  'driver', // only who drives now
  'supervise', // supervisors, which need grants
] as const;
export type CommandGiver = (typeof commandGivers)[number];

/** Publishes one message, which never changes. */
export interface PublishAction {
  kind: 'publish';
  topic: string;
  /** In ROS 2 notation. */
  type: string;
  /** The message, serialised for the robot's graph. */
  bytes: Uint8Array;
}

/** Calls a service of the robot's ROS graph. */
export interface CallAction {
  kind: 'call';
  service: string;
  type: ServiceType;
  /** Of std_srvs/SetBool. */
  data: boolean;
}

/** Sends a goal, which never changes, to an action server of the robot's ROS graph. */
export interface GoalAction {
  kind: 'goal';
  /** The action's name, under which its topics and services are. */
  action: string;
  /** Such as `move_base_msgs/MoveBase`. */
  type: string;
  /** The definition of the goal, as in the .action file above its first line of dashes. */
  definition: string;
  /** The goal, serialised for the robot's graph. */
  bytes: Uint8Array;
}

/** What a ROS graph does. */
export type GraphAction = PublishAction | CallAction | GoalAction;

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
  who: CommandGiver;
  /** Only while the robot stands still. */
  standing: boolean;
  /** STOP cancels it, and while STOP is latched it is refused; or it goes on, and is taken. */
  onStop: 'cancel' | 'continue';
  /** How often it may be given, by all operators together. */
  perSecond: number;
  /** Without an end for so long, nobody waits for it any more, ms. */
  timeoutMs: number;
  action: CommandAction;
}

export interface CommandsConfiguration {
  commands: readonly CommandOptions[];
  /** `null`: no command needs one. */
  graph: GraphOptions | null;
}
