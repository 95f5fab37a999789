import { expect, it } from 'vitest';
import { RosFault } from './fault.ts';
import { isFiniteVector, pointCloud2Schema, tfMessageSchema, unitQuaternion } from './messages.ts';

const header = { stamp: { sec: 1, nanosec: 2 }, frame_id: 'base_link' };
const transform = (x: number, w: number) => ({
  ...{ header, child_frame_id: 'lidar' },
  transform: { translation: { x, y: 0, z: 0 }, rotation: { x: 0, y: 0, z: 0, w } },
});

it('a transform that is none is read with the others, so that it alone can be left out', () => {
  const given = [
    transform(1, 1),
    transform(Number.NaN, 1),
    transform(1, Number.POSITIVE_INFINITY),
    transform(1, 0),
  ];
  const { transforms } = tfMessageSchema.parse({ transforms: given });
  const usable = transforms.map(
    (each) => isFiniteVector(each.transform.translation) && unitQuaternion(each.transform.rotation) !== null,
  );
  expect(usable).toEqual([true, false, false, false]);
});

it('a message that a schema refuses is reported in a sentence, with the place', () => {
  const faultOf = (message: unknown) => {
    const { error } = pointCloud2Schema.safeParse(message);
    return RosFault.of(error, '/points').message;
  };
  expect(faultOf(null)).toMatch(/^\/points: the message: /);
  const cloud = { header, fields: [{ name: 'x', offset: -1, datatype: 7, count: 1 }] };
  const rest = {
    height: 1,
    width: 1,
    is_bigendian: false,
    point_step: 4,
    row_step: 4,
    data: new Uint8Array(4),
  };
  expect(faultOf({ ...cloud, ...rest })).toMatch(/^\/points: fields\[0\]\.offset: [^{}]+$/);
  expect(faultOf({ ...cloud, ...rest, width: 'a' })).toMatch(/, and 1 more$/);
});
