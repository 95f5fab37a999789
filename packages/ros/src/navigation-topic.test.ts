import type { Pose } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import { NavigationTopic } from './navigation-topic.ts';
import { topicTableSchema } from './topic-table.ts';

const HERE: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const [pathEntry, mapEntry, fixEntry] = topicTableSchema.parse([
  { topic: '/plan', as: 'path' },
  { topic: '/map', as: 'map', label: 'Floor 2' },
  { topic: '/fix', as: 'fix' },
]);
const header = { stamp: { sec: 7, nanosec: 0 }, frame_id: 'map' };
const poseAt = (x: number, y: number) => ({ pose: { ...HERE, position: { x, y, z: 0 } } });
const plan = { header, poses: [poseAt(0, 0), poseAt(3, 4), poseAt(3, 5.25)] };
const map = {
  header,
  info: { resolution: 0.05, width: 40, height: 20, origin: HERE },
  data: new Int8Array(800),
};

it('knows its topics', () => {
  expect(
    [pathEntry, mapEntry, fixEntry].map((entry) => entry !== undefined && NavigationTopic.is(entry)),
  ).toEqual([...[true, true, false]]);
  expect([pathEntry?.most, mapEntry?.most]).toEqual([5, 1]);
});

it('says what there is, for people and for the picture', () => {
  const path = new NavigationTopic(pathEntry!);
  expect(path.take(plan, () => HERE)).toMatchObject({
    ...{ topic: '/plan', label: 'Path', level: 'ok', values: [['', '6.3 m']] },
    navigation: {
      kind: 'path',
      points: [
        [0, 0],
        [3, 4],
        [3, 5.25],
      ],
    },
  });
  expect(path.take({ header, poses: [] }, () => null)).toMatchObject({ level: 'ok', values: [['', 'none']] });
  const reading = new NavigationTopic(mapEntry!).take(map, () => HERE);
  expect(reading).toMatchObject({ label: 'Floor 2', values: [['', '2.0 × 1.0 m, cells of 0.05 m']] });
});

it('what waits for its frame is placed when that becomes known, once', () => {
  const topic = new NavigationTopic(mapEntry!);
  const stamps: bigint[] = [];
  const refused = topic.take(map, (_, stampNs) => {
    stamps.push(stampNs);
    return null;
  });
  expect(stamps).toEqual([7_000_000_000n]);
  expect(refused).toMatchObject({
    level: 'warn',
    values: [['', 'not shown: where map is, is unknown']],
    navigation: { kind: 'refused', of: 'map', reason: 'unknown-frame', frame: 'map' },
  });
  expect(topic.retry(() => null)).toBe(null);
  expect(topic.waits).toBe(true);
  expect(topic.retry(() => HERE)).toMatchObject({ level: 'ok', navigation: { kind: 'map' } });
  expect(topic.waits).toBe(false);
  expect(topic.retry(() => HERE)).toBe(null);
});
