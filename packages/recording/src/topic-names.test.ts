import fc from 'fast-check';
import { expect, it } from 'vitest';
import { alarmTopics, pictureTopics, quantityTopics } from './topic-names.ts';

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

it('names topics after quantities, and after what alarms watch', () => {
  const quantities = [
    { topic: '/gripper/temperature', field: 'data' },
    { topic: '/arm', field: 'motor.current' },
    { topic: '/arm', field: 'temperatures[0]' },
  ];
  expect(quantityTopics(quantities)).toEqual([
    '/farpoint/quantities/gripper_temperature',
    '/farpoint/quantities/arm_motor_current',
    '/farpoint/quantities/arm_temperatures_0_',
  ]);
  expect(alarmTopics(['charge', '/arm motor.current', 'charge'])).toEqual([
    '/farpoint/alarms/charge',
    '/farpoint/alarms/arm_motor_current',
    '/farpoint/alarms/charge_2',
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
