import { actionTypes, fixedMessage, goalDefinitions } from '@farpoint/ros';
import { MemoryGraph } from '@farpoint/ros/testing';
import { expect, it } from 'vitest';
import type { GoalAction } from './command-configuration.ts';
import { GoalClient } from './goal-client.ts';

const definition = 'string station';
const dock: GoalAction = {
  ...{ kind: 'goal', action: '/dock', type: 'robot_msgs/Dock', definition },
  bytes: fixedMessage(
    ...([1, actionTypes('robot_msgs/Dock').goal, { station: 'a' }] as const),
    goalDefinitions('robot_msgs/Dock', definition).goal,
  ),
};

/** A result’s or feedback’s beginning: header, goal id, status, text. */
function statusBytes(id: string, status: number, text: string): Uint8Array {
  const utf8 = (value: string) => {
    const bytes = new TextEncoder().encode(value);
    return [bytes.length, 0, 0, 0, ...bytes];
  };
  return Uint8Array.of(
    ...Array<number>(12).fill(0),
    ...utf8('map'),
    ...Array<number>(8).fill(0),
    ...utf8(id),
    status,
    ...utf8(text),
    7,
  );
}

function bench() {
  const graph = new MemoryGraph(1, () => 0);
  const client = new GoalClient(graph, dock, 'farpoint');
  const said: string[] = [];
  const send = () =>
    client.send(dock.bytes, 5000, {
      progress: (_, detail) => said.push(`progress ${detail}`),
      end: ({ state, detail }) => said.push(`${state} ${detail}`),
    });
  const sent = (topic: string) =>
    (graph.published.get(topic) ?? []).map((bytes) => String.fromCharCode(...bytes));
  return { graph, said, send, sent };
}

it('sends a goal, hears its feedback and its end, and nothing of others’', () => {
  const { graph, said, send, sent } = bench();
  send();
  expect(graph.advertised).toMatchObject([
    { topic: '/dock/goal', type: 'robot_msgs/msg/DockActionGoal' },
    { topic: '/dock/cancel', type: 'actionlib_msgs/msg/GoalID' },
  ]);
  expect(graph.subscribed.map(({ topic, type }) => `${topic} ${type}`)).toEqual([
    '/dock/feedback robot_msgs/msg/DockActionFeedback',
    '/dock/result robot_msgs/msg/DockActionResult',
  ]);
  expect(sent('/dock/goal')[0]).toContain('farpoint-1-5000\u0001\0\0\0a');
  graph.sayBytes('/dock/feedback', statusBytes('farpoint-1-5000', 1, 'turning'));
  graph.sayBytes('/dock/feedback', statusBytes('other', 1, 'of another node'));
  graph.sayBytes('/dock/result', statusBytes('other', 3, ''));
  graph.sayBytes('/dock/result', Uint8Array.of(1, 2, 3));
  graph.sayBytes('/dock/result', statusBytes('farpoint-1-5000', 1, 'no end'));
  expect(said).toEqual(['progress turning']);
  graph.sayBytes('/dock/result', statusBytes('farpoint-1-5000', 3, 'docked'));
  graph.sayBytes('/dock/result', statusBytes('farpoint-1-5000', 4, 'twice'));
  expect(said.slice(1)).toEqual(['done docked']);
});

it.each([
  [2, 'cancelled'],
  [4, 'failed'],
  [5, 'failed'],
  [8, 'cancelled'],
  [9, 'failed'],
])('the status %i is told as %s', (status, state) => {
  const { graph, said, send } = bench();
  send();
  graph.sayBytes('/dock/result', statusBytes('farpoint-1-5000', status, 'x'));
  expect(said).toEqual([`${state} x`]);
});

it('cancels the goal by its own name, and not once it has ended', () => {
  const { graph, send, sent } = bench();
  const [first, second] = [send(), send()];
  second();
  expect(sent('/dock/cancel')).toHaveLength(1);
  expect(sent('/dock/cancel')[0]).toContain('farpoint-2-5000');
  graph.sayBytes('/dock/result', statusBytes('farpoint-1-5000', 3, ''));
  first();
  expect(sent('/dock/cancel')).toHaveLength(1);
});
