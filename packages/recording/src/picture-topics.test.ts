import fc from 'fast-check';
import { expect, it } from 'vitest';
import { pictureTopics } from './picture-topics.ts';

it('names topics after cameras', () => {
  expect(pictureTopics(['Front', '/rear/image_raw', 'Front', '3D left', 'Камера', '/'])).toEqual([
    '/farpoint/pictures/Front',
    '/farpoint/pictures/rear_image_raw',
    '/farpoint/pictures/Front_2',
    '/farpoint/pictures/_3D_left',
    '/farpoint/pictures/______',
    '/farpoint/pictures/camera',
  ]);
});

it('produces valid, unique ROS names', () => {
  const name = fc.oneof(fc.string(), fc.constantFrom('a', 'a_2', 'a b', 'a-b', ''));
  fc.assert(
    fc.property(fc.array(name, { maxLength: 8 }), (names) => {
      const topics = pictureTopics(names);
      expect(new Set(topics).size).toBe(names.length);
      for (const topic of topics) expect(topic).toMatch(/^(\/[A-Za-z_][A-Za-z0-9_]*)+$/);
    }),
  );
});
