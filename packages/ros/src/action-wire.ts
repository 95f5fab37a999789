/**
 * The messages of an action server of ROS 2. A goal is sent by a service, as is the wish to cancel it; another service
 * answers when the goal ends. Two topics tell how it goes. The goal’s fields are the action’s own; all before them is the
 * same for all actions. Source: the ROS 2 design article “Actions”, and action_msgs. Pure.
 */
import { CdrFields } from './cdr-fields.ts';
import { RosFault } from './fault.ts';
import type { ServiceAs } from './graph.ts';
import { ros1TypeOf } from './topic-table.ts';
import { ENCAPSULATION_BYTES } from './wire-check.ts';

/** unique_identifier_msgs/UUID; action-wire.test.ts holds it. */
const ID_BYTES = 16;
const TIME_BYTES = 8;
/** Of a server’s goals that ended lately. Chosen: servers forget them after minutes; action-wire.test.ts holds it. */
const MOST_GOALS = 1024;
const LITTLE_CDR = [0, 1, 0, 0] as const;

/** The states of a goal (action_msgs/GoalStatus). */
const STEPS = ['unknown', 'accepted', 'running', 'cancelling', 'done', 'cancelled', 'failed'] as const;
export type ActionStep = (typeof STEPS)[number];

/** The services and topics of an action. @param action its full name @param type such as `nav2_msgs/NavigateToPose` */
export function actionServices(
  action: string,
  type: string,
): {
  send: ServiceAs;
  cancel: ServiceAs;
  result: ServiceAs;
  feedback: { topic: string; type: string };
  status: { topic: string; type: string };
} {
  const [packageName = '', name = ''] = ros1TypeOf(type).split('/');
  const own = `${packageName}/action/${name}`;
  const of = (service: string, types: string): ServiceAs => ({
    service: `${action}/_action/${service}`,
    request: `${types}_Request`,
    reply: `${types}_Response`,
  });
  return {
    send: of('send_goal', `${own}_SendGoal`),
    cancel: of('cancel_goal', 'action_msgs/srv/CancelGoal'),
    result: of('get_result', `${own}_GetResult`),
    feedback: { topic: `${action}/_action/feedback`, type: `${own}_FeedbackMessage` },
    status: { topic: `${action}/_action/status`, type: 'action_msgs/msg/GoalStatusArray' },
  };
}

/** @param id 16 bytes that name the goal @param goal serialised; behind 16 bytes its numbers stay aligned */
export function goalRequest(id: Uint8Array, goal: Uint8Array): Uint8Array {
  return Uint8Array.of(
    ...goal.subarray(0, ENCAPSULATION_BYTES),
    ...id,
    ...goal.subarray(ENCAPSULATION_BYTES),
  );
}

/** Asks for the goal’s result, which comes when it has ended. */
export function resultRequest(id: Uint8Array): Uint8Array {
  return Uint8Array.of(...LITTLE_CDR, ...id);
}

/** Asks for one goal to be cancelled, whenever it was sent (action_msgs/CancelGoal). */
export function cancelRequest(id: Uint8Array): Uint8Array {
  return Uint8Array.of(...LITTLE_CDR, ...id, ...new Uint8Array(TIME_BYTES));
}

/** @returns whether the server accepts the goal @throws {RosFault} `bad-message` */
export function readGoalReply(bytes: Uint8Array): boolean {
  const fields = new CdrFields(bytes);
  const isAccepted = fields.bool();
  fields.uint32();
  fields.uint32();
  return isAccepted;
}

/** @returns whether the server cancels the goal @throws {RosFault} `bad-message` */
export function readCancelReply(bytes: Uint8Array): boolean {
  const fields = new CdrFields(bytes);
  const code = fields.int8();
  return fields.uint32() > 0 && code === 0;
}

/** Reads the beginning of a result, which is the same for all actions. @throws {RosFault} `bad-message` */
export function readResultStep(bytes: Uint8Array): ActionStep {
  return stepOf(new CdrFields(bytes).int8());
}

/** @returns the goal that feedback is about @throws {RosFault} `bad-message` */
export function feedbackGoal(bytes: Uint8Array): Uint8Array {
  return new CdrFields(bytes).bytes(ID_BYTES);
}

/** Reads the states of a server’s goals (action_msgs/GoalStatusArray). @throws {RosFault} `bad-message` */
export function readGoalSteps(bytes: Uint8Array): { id: Uint8Array; step: ActionStep }[] {
  const fields = new CdrFields(bytes);
  const count = Math.min(fields.uint32(), MOST_GOALS);
  const steps: { id: Uint8Array; step: ActionStep }[] = [];
  for (let i = 0; i < count; i++) {
    const id = fields.bytes(ID_BYTES);
    fields.uint32();
    fields.uint32();
    steps.push({ id, step: stepOf(fields.int8()) });
  }
  return steps;
}

function stepOf(code: number): ActionStep {
  const step = STEPS[code];
  if (step === undefined) throw new RosFault('bad-message', `the status ${code}`);
  return step;
}
