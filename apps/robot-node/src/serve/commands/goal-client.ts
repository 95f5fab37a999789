/** Goals of one action server of a ROS 1 graph: sends them, cancels them, and hears how they end. */
import {
  actionTypes,
  cancelMessage,
  goalDefinitions,
  goalMessage,
  isLastStatus,
  type Publisher,
  RosFault,
  type RosGraph,
  readGoalStatus,
} from '@farpoint/ros';
import type { ActionPort, ActionResult } from './command-actor.ts';
import type { GoalAction } from './command-configuration.ts';

/** Results that wait. Chosen: one goal runs at a time, and others’ results pass by; goal-client.test.ts holds it. */
const QUEUE = 16;

const RESULTS = {
  cancelled: 'cancelled',
  done: 'done',
  failed: 'failed',
  refused: 'failed',
  lost: 'failed',
} as const satisfies Record<string, ActionResult['state']>;

export class GoalClient {
  readonly #name: string;
  readonly #goals: Publisher;
  readonly #cancels: Publisher;
  readonly #open = new Map<string, ActionPort>();
  readonly #prefix: string;
  #count = 0;

  /** @param prefix begins the goals’ names, which must differ from those of other nodes @throws {RosFault} */
  constructor(graph: RosGraph, { action, type, definition }: GoalAction, prefix: string) {
    const types = actionTypes(type);
    this.#name = action;
    this.#prefix = prefix;
    const { action: definitions } = goalDefinitions(type, definition);
    this.#goals = graph.advertise({ topic: `${action}/goal`, type: types.action, definitions });
    this.#cancels = graph.advertise({ topic: `${action}/cancel`, type: 'actionlib_msgs/msg/GoalID' });
    const hear = (part: 'feedback' | 'result', isResult: boolean) =>
      graph.subscribe({ topic: `${action}/${part}`, type: types[part], queue: QUEUE }, (bytes) =>
        this.#take(bytes, isResult),
      );
    hear('feedback', false);
    hear('result', true);
  }

  /** @param nowMs since 1970 @returns cancels it */
  send(goal: Uint8Array, nowMs: number, port: ActionPort): () => void {
    if (this.#goals.subscribers === 0) {
      port.end({ state: 'failed', detail: `there is no action server ${this.#name}` });
      return () => undefined;
    }
    const id = `${this.#prefix}-${++this.#count}-${nowMs}`;
    this.#open.set(id, port);
    this.#goals.publish(goalMessage(id, nowMs, goal));
    return () => {
      if (this.#open.has(id)) this.#cancels.publish(cancelMessage(id));
    };
  }

  #take(bytes: Uint8Array, isResult: boolean): void {
    let status: ReturnType<typeof readGoalStatus>;
    try {
      status = readGoalStatus(bytes);
    } catch (error) {
      // Of another action, or of another node’s: none of ours.
      if (error instanceof RosFault) return;
      throw error;
    }
    const { id, state, text } = status;
    const port = this.#open.get(id);
    if (port === undefined) return;
    if (!isResult) port.progress(null, text);
    else if (isLastStatus(state)) {
      this.#open.delete(id);
      port.end({ state: RESULTS[state as keyof typeof RESULTS], detail: text });
    }
  }
}
