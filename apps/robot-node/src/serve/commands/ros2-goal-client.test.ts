import { RosFault } from '@farpoint/ros';
import { MemoryServiceGraph } from '@farpoint/ros/testing';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { GoalAction } from './command-configuration.ts';
import { Ros2GoalClient } from './ros2-goal-client.ts';

const CDR = [0, 1, 0, 0];
const dock: GoalAction = {
  ...{ kind: 'goal', action: '/dock', type: 'robot_msgs/Dock', definition: 'uint8 station' },
  bytes: Uint8Array.of(...CDR, 3),
};
const SEND = '/dock/_action/send_goal';
const CANCEL = '/dock/_action/cancel_goal';
const RESULT = '/dock/_action/get_result';
const STAMP = [0, 0, 0, 5, 0, 0, 0, 6, 0, 0, 0];
const ACCEPTED = Uint8Array.of(...CDR, 1, ...STAMP);
const REFUSED = Uint8Array.of(...CDR, 0, ...STAMP);
const idOf = (number: number) => new Uint8Array(16).fill(number);
const stateOf = (id: Uint8Array, status: number) =>
  Uint8Array.of(...CDR, 1, 0, 0, 0, ...id, 5, 0, 0, 0, 6, 0, 0, 0, status);
const cancelReply = (code: number, goals: number) => Uint8Array.of(...CDR, code, 0, 0, 0, goals, 0, 0, 0);

function bench() {
  const graph = new MemoryServiceGraph(() => 0);
  let last = 0;
  const client = new Ros2GoalClient(graph, dock, () => idOf(++last));
  const said: string[] = [];
  const send = () =>
    client.send(dock.bytes, {
      progress: (_, detail) => said.push(`progress ${detail}`),
      end: ({ state, detail }) => said.push(`${state} ${detail}`),
    });
  const callsOf = (service: string) => graph.calls.filter((each) => each.service === service);
  /** Answers the newest call, and lets the client go on. */
  const answer = async (service: string, what: Uint8Array | RosFault) => {
    const call = callsOf(service).at(-1);
    if (what instanceof RosFault) call?.fail(what);
    else call?.reply(what);
    await new Promise(setImmediate);
  };
  return { graph, said, send, callsOf, answer };
}

describe('goals of a ROS 2 action server', () => {
  it('are sent, told while they run, and asked for their result', async () => {
    const { graph, said, send, callsOf, answer } = bench();
    send();
    expect(graph.clients.map(({ service }) => service)).toEqual([SEND, CANCEL, RESULT]);
    expect(graph.subscribed).toMatchObject([
      { topic: '/dock/_action/feedback', type: 'robot_msgs/action/Dock_FeedbackMessage', queue: 16 },
      { topic: '/dock/_action/status', type: 'action_msgs/msg/GoalStatusArray', queue: 16 },
    ]);
    expect([...(callsOf(SEND)[0]?.request ?? [])]).toEqual([...CDR, ...idOf(1), 3]);
    expect(callsOf(SEND)[0]?.withinMs).toBeGreaterThan(600_000);
    expect(callsOf(RESULT)).toEqual([]);
    await answer(SEND, ACCEPTED);
    expect([...(callsOf(RESULT)[0]?.request ?? [])]).toEqual([...CDR, ...idOf(1)]);
    graph.sayBytes('/dock/_action/status', stateOf(idOf(1), 2));
    graph.sayBytes('/dock/_action/status', stateOf(idOf(9), 3));
    graph.sayBytes('/dock/_action/status', Uint8Array.of(1));
    graph.sayBytes('/dock/_action/feedback', Uint8Array.of(...CDR, ...idOf(1), 1, 2));
    graph.sayBytes('/dock/_action/feedback', Uint8Array.of(...CDR, ...idOf(9), 1, 2));
    // How it ends, its result says.
    graph.sayBytes('/dock/_action/status', stateOf(idOf(1), 4));
    expect(said).toEqual(['progress running', 'progress running']);
    await answer(RESULT, Uint8Array.of(...CDR, 4, 0, 0, 0, 9));
    graph.sayBytes('/dock/_action/status', stateOf(idOf(1), 2));
    expect(said.slice(2)).toEqual(['done ']);
    expect(callsOf(CANCEL)).toEqual([]);
  });

  it.each([
    [4, 'done '],
    [5, 'cancelled '],
    [6, 'failed '],
    [0, 'failed its last state is unknown'],
    [2, 'failed its last state is running'],
  ])('end with the status %i as %s', async (status, told) => {
    const { said, send, answer } = bench();
    send();
    await answer(SEND, ACCEPTED);
    await answer(RESULT, Uint8Array.of(...CDR, status));
    expect(said).toEqual([told]);
  });

  it('may be refused', async () => {
    const { said, send, answer, callsOf } = bench();
    send();
    await answer(SEND, REFUSED);
    expect(said).toEqual(['failed the action server /dock refuses the goal']);
    expect(callsOf(RESULT)).toEqual([]);
    expect(callsOf(CANCEL)).toEqual([]);
  });

  it('are cancelled by their own names, and not once they have ended', async () => {
    const { said, send, answer, callsOf } = bench();
    const first = send();
    await answer(SEND, ACCEPTED);
    const second = send();
    await answer(SEND, ACCEPTED);
    second();
    second();
    expect(callsOf(CANCEL).map(({ request }) => [...request])).toEqual([
      [...CDR, ...idOf(2), 0, 0, 0, 0, 0, 0, 0, 0],
    ]);
    expect(callsOf(CANCEL)[0]?.withinMs).toBe(5000);
    await answer(CANCEL, cancelReply(0, 1));
    await answer(RESULT, Uint8Array.of(...CDR, 5));
    expect(said).toEqual(['cancelled ']);
    callsOf(RESULT)[0]?.reply(Uint8Array.of(...CDR, 4));
    await new Promise(setImmediate);
    first();
    expect(callsOf(CANCEL)).toHaveLength(1);
  });

  it('are cancelled also where the server takes them after that', async () => {
    const { send, answer, callsOf } = bench();
    const cancel = send();
    cancel();
    expect(callsOf(CANCEL)).toHaveLength(1);
    await answer(CANCEL, cancelReply(2, 0));
    await answer(SEND, ACCEPTED);
    expect(callsOf(CANCEL)).toHaveLength(2);
    expect(callsOf(CANCEL)[1]?.request).toEqual(callsOf(CANCEL)[0]?.request);
  });

  it('go on where the server does not cancel them, which is told', async () => {
    const { said, send, answer } = bench();
    const cancel = send();
    await answer(SEND, ACCEPTED);
    cancel();
    await answer(CANCEL, cancelReply(1, 0));
    expect(said).toEqual(['progress the action server does not cancel it']);
    await answer(RESULT, Uint8Array.of(...CDR, 4));
    expect(said[1]).toBe('done ');
  });

  it.each([
    ['unavailable', 'failed there is no action server /dock'],
    ['unsupported', 'failed /dock: why; do this'],
    ['wrong-type', 'failed /dock: why; do this'],
  ] as const)('fail where the server is %s, and nothing needs to be cancelled', async (code, told) => {
    const { said, send, answer, callsOf } = bench();
    send();
    await answer(SEND, new RosFault(code, 'why', { remedy: 'do this' }));
    expect(said).toEqual([told]);
    expect(callsOf(CANCEL)).toEqual([]);
  });

  it.each([CANCEL, RESULT])('are not sent where there is no %s', async (absent) => {
    const { graph, said, send, callsOf } = bench();
    graph.absent.add(absent);
    send();
    await new Promise(setImmediate);
    expect(said).toEqual([`failed the action server has no ${absent}`]);
    expect(callsOf(SEND)).toEqual([]);
  });

  it('are cancelled where their result cannot be asked for', async () => {
    const { said, send, answer, callsOf } = bench();
    send();
    await answer(SEND, ACCEPTED);
    await answer(RESULT, new RosFault('unavailable', 'there is no such service', { topic: RESULT }));
    expect(callsOf(CANCEL)).toHaveLength(1);
    expect(said).toEqual([`failed ${RESULT}: there is no such service`]);
  });

  it('are cancelled where nobody knows whether they run', async () => {
    for (const bad of [new RosFault('lost', 'gone'), Uint8Array.of(...CDR, 7), new Uint8Array()]) {
      const { said, send, answer, callsOf } = bench();
      send();
      await answer(SEND, bad);
      expect(callsOf(CANCEL)).toHaveLength(1);
      expect(said).toMatchObject([expect.stringMatching(/^failed \/dock: /)]);
      await answer(CANCEL, new RosFault('lost', 'gone'));
      expect(said).toHaveLength(1);
    }
  });

  it('end once, whatever the server answers', async () => {
    const bytes = fc.uint8Array({ maxLength: 40 });
    await fc.assert(
      fc.asyncProperty(bytes, bytes, bytes, async (reply, result, news) => {
        const { graph, said, send, answer } = bench();
        send();
        await answer(SEND, reply);
        graph.sayBytes('/dock/_action/status', news);
        graph.sayBytes('/dock/_action/feedback', news);
        await answer(RESULT, result);
        const ends = said.filter((each) => !each.startsWith('progress'));
        expect(ends.length).toBeLessThanOrEqual(1);
      }),
    );
  });
});
