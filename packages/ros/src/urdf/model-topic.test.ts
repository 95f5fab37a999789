import { expect, test } from 'vitest';
import { topicTableSchema } from '../topic-table.ts';
import { ModelTopic } from './model-topic.ts';

const [MODEL, JOINTS] = topicTableSchema.parse([
  { topic: '/robot_description', as: 'model' },
  { topic: '/joint_states', as: 'joints' },
]) as [Entry, Entry];
type Entry = ReturnType<typeof topicTableSchema.parse>[number];
const STAMP = { header: { stamp: { sec: 0, nanosec: 0 }, frame_id: '' } };

test('a description becomes a model; what is not drawn is a warning', () => {
  const topic = new ModelTopic(MODEL);
  const link = (geometry: string) =>
    `<robot name="r"><link name="a"><visual><geometry>${geometry}</geometry></visual></link></robot>`;
  expect(topic.take({ data: link('<sphere radius="1"/>') }, 0)).toMatchObject({
    ...{ topic: '/robot_description', level: 'ok', values: [] },
    model: { kind: 'model', model: { joints: [] } },
  });
  expect(topic.take({ data: link('<mesh filename="a.stl"/>') }, 0)).toMatchObject({
    level: 'warn',
    values: [['', 'not drawn: it has no boxes, cylinders or spheres']],
  });
  expect(topic.take({ data: '<robot>' }, 0)).toMatchObject({
    ...{ level: 'warn', values: [['', 'not drawn: line 1: <robot> of line 1 is not closed']] },
    model: { kind: 'refused', fault: { code: 'not-xml' } },
  });
  expect(() => topic.take({ data: 7 }, 0)).toThrow();
});

test('joint states of several nodes are merged, and told 20 times a second', () => {
  const topic = new ModelTopic(JOINTS);
  const take = (name: string[], position: number[] | Float64Array, nowMs: number) =>
    topic.take({ ...STAMP, name, position }, nowMs)?.joints;
  expect(take(['a', 'b'], Float64Array.of(1, 2), 0)).toEqual([
    ['a', 1],
    ['b', 2],
  ]);
  expect(take(['c'], [3], 5)).toBeUndefined();
  expect(take(['a', 'd'], [Number.NaN, Number.POSITIVE_INFINITY], 10)).toBeUndefined();
  expect(take(['b'], [4], 50)).toEqual([
    ['a', 1],
    ['b', 4],
    ['c', 3],
  ]);
  expect(take(['e'], [], 100)).toHaveLength(3);
  expect(() => topic.take({ ...STAMP, name: 'a', position: [] }, 0)).toThrow();
});
