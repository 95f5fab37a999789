/** Goals of one action server of a ROS 2 graph: sends them, cancels them, and hears how they go and how they end. */
import { randomBytes } from 'node:crypto';
import {
  type ActionStep,
  actionServices,
  cancelRequest,
  feedbackGoal,
  goalRequest,
  RELIABLE_QOS,
  RosFault,
  type RosFaultCode,
  readCancelReply,
  readGoalReply,
  readGoalSteps,
  readResultStep,
  resultRequest,
  type ServiceClient,
  type ServiceGraph,
} from '@farpoint/ros';
import type { ActionPort, ActionResult } from './command-actor.ts';
import type { GoalAction } from './command-configuration.ts';

/** Feedback and states that wait. Chosen: the newest counts, and others’ goals pass by; ros2-goal-client.test.ts holds it. */
const QUEUE = 16;
/** A goal’s answers have so long, ms. Chosen: more than any command’s time, at whose end it is cancelled; ros2-goal-client.test.ts holds it. */
const LONGEST_MS = 660_000;
/** The answer to a cancel has so long, ms. Chosen: nobody waits for it after two seconds; ros2-goal-client.test.ts holds it. */
const CANCEL_MS = 5000;

const RESULTS: Partial<Record<ActionStep, ActionResult['state']>> = {
  done: 'done',
  cancelled: 'cancelled',
  failed: 'failed',
};

/** With these, a goal was not sent; with others it may be under way. */
const UNSENT: ReadonlySet<RosFaultCode> = new Set(['unavailable', 'unsupported', 'wrong-type']);

interface OpenGoal {
  readonly id: Uint8Array;
  readonly port: ActionPort;
  isAccepted: boolean;
  isCancelled: boolean;
  hasEnded: boolean;
}

export class Ros2GoalClient {
  readonly #name: string;
  readonly #newId: () => Uint8Array;
  readonly #services: Record<'send' | 'cancel' | 'result', ServiceClient>;
  readonly #open = new Map<string, OpenGoal>();

  /** @param newId 16 bytes that name a goal, and no other of any node @throws {RosFault} */
  constructor(graph: ServiceGraph, { action, type }: GoalAction, newId = newGoalId) {
    this.#name = action;
    this.#newId = newId;
    const { send, cancel, result, feedback, status } = actionServices(action, type);
    this.#services = {
      send: graph.serviceClient(send),
      cancel: graph.serviceClient(cancel),
      result: graph.serviceClient(result),
    };
    graph.subscribe({ ...feedback, queue: QUEUE, qos: RELIABLE_QOS }, (bytes) =>
      this.#hear(() => [{ id: feedbackGoal(bytes), step: 'running' }]),
    );
    // As rcl_action publishes it: who comes late hears the newest.
    const latched = { reliability: 'reliable', durability: 'transient-local', depth: 1 } as const;
    graph.subscribe({ ...status, queue: QUEUE, qos: latched }, (bytes) =>
      this.#hear(() => readGoalSteps(bytes)),
    );
  }

  /** @param bytes the goal, serialised @returns cancels it */
  send(bytes: Uint8Array, port: ActionPort): () => void {
    const goal: OpenGoal = {
      id: this.#newId(),
      port,
      isAccepted: false,
      isCancelled: false,
      hasEnded: false,
    };
    this.#open.set(keyOf(goal.id), goal);
    this.#run(goal, bytes).then(
      (result) => this.#end(goal, result),
      (error: unknown) => this.#fail(goal, error),
    );
    return () => {
      if (goal.hasEnded || goal.isCancelled) return;
      goal.isCancelled = true;
      void this.#cancel(goal);
    };
  }

  async #run(goal: OpenGoal, bytes: Uint8Array): Promise<ActionResult> {
    const { send, cancel, result } = this.#services;
    // What could not be cancelled is not begun.
    const absent = [cancel, result].find(({ isReady }) => !isReady);
    if (send.isReady && absent !== undefined)
      return { state: 'failed', detail: `the action server has no ${absent.service}` };
    if (!readGoalReply(await send.call(goalRequest(goal.id, bytes), LONGEST_MS)))
      return { state: 'failed', detail: `the action server ${this.#name} refuses the goal` };
    goal.isAccepted = true;
    // What was cancelled before was unknown to the server, or was not.
    if (goal.isCancelled) void this.#cancel(goal);
    const step = readResultStep(await result.call(resultRequest(goal.id), LONGEST_MS));
    const state = RESULTS[step];
    return { state: state ?? 'failed', detail: state === undefined ? `its last state is ${step}` : '' };
  }

  #end(goal: OpenGoal, result: ActionResult): void {
    goal.hasEnded = true;
    this.#open.delete(keyOf(goal.id));
    goal.port.end(result);
  }

  #fail(goal: OpenGoal, error: unknown): void {
    const fault = RosFault.of(error, this.#name);
    const isUnsent = !goal.isAccepted && UNSENT.has(fault.code);
    if (!isUnsent) void this.#cancel(goal);
    const isAbsent = isUnsent && fault.code === 'unavailable';
    const detail = isAbsent ? `there is no action server ${this.#name}` : fault.message;
    this.#end(goal, { state: 'failed', detail });
  }

  async #cancel(goal: OpenGoal): Promise<void> {
    let isTaken: boolean;
    try {
      isTaken = readCancelReply(await this.#services.cancel.call(cancelRequest(goal.id), CANCEL_MS));
    } catch (error) {
      // The goal’s own end tells it.
      if (error instanceof RosFault) return;
      throw error;
    }
    if (!isTaken && goal.isAccepted && !goal.hasEnded)
      goal.port.progress(null, 'the action server does not cancel it');
  }

  /** @param read may throw: what others say is not trusted to be of the type */
  #hear(read: () => { id: Uint8Array; step: ActionStep }[]): void {
    let steps: ReturnType<typeof read>;
    try {
      steps = read();
    } catch (error) {
      if (error instanceof RosFault) return;
      throw error;
    }
    for (const { id, step } of steps) {
      // How it ends is told by its result.
      if (RESULTS[step] === undefined) this.#open.get(keyOf(id))?.port.progress(null, step);
    }
  }
}

function keyOf(id: Uint8Array): string {
  return Buffer.from(id).toString('hex');
}

/** A random identifier (RFC 9562, 5.4). */
function newGoalId(): Uint8Array {
  const id = randomBytes(16);
  id[6] = ((id[6] as number) & 0x0f) | 0x40;
  id[8] = ((id[8] as number) & 0x3f) | 0x80;
  return id;
}
