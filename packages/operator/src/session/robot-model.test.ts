import {
  encodeModelMeshes,
  type ModelLink,
  type ModelMeshes,
  type ModelMeshParts,
  type ModelPart,
  type ModelShape,
  ProtocolError,
  type RobotModelParts,
} from '@farpoint/protocol';
import { beforeEach, expect, test } from 'vitest';
import { RobotModel } from './robot-model.ts';

const link = (parent: number): ModelLink => ({
  ...{ part: 'link', parent, place: [0, 0, 0, 0, 0, 0, 1], moves: 'turns', axis: [0, 0, 1] },
});
const ball = (of: number): ModelShape => ({
  ...{ part: 'shape', link: of, place: [0, 0, 0, 0, 0, 0, 1], form: 'sphere', size: [1], colour: 0 },
});
const message = (at: number, count: number, ...parts: ModelPart[]): RobotModelParts => ({
  ...{ type: 'robotModel', number: 1, count, at, parts },
});
const joints = (timeMs: number, ...positions: number[]) => ({
  ...({ type: 'joints', model: 1, timeMs, ageMs: 5, positions } as const),
});

let model: RobotModel;
beforeEach(() => {
  model = new RobotModel();
});

test('a model is there when all its parts are', () => {
  expect(model.takeParts(message(0, 3, link(0), link(1)))).toBe(false);
  expect(model.shapes).toEqual([]);
  expect(model.takeParts(message(2, 3, ball(2)))).toBe(true);
  expect(model.links).toHaveLength(2);
  expect(model.shapes).toHaveLength(1);
  expect(model.changes).toBe(1);
  expect(model.takeParts(message(0, 0))).toBe(true);
  expect(model.shapes).toEqual([]);
});

test.each<[string, RobotModelParts[]]>([
  ['begins in the middle', [message(1, 2, ball(0))]],
  ['has a gap', [message(0, 3, ball(0)), message(2, 3, ball(0))]],
  ['changes its size', [message(0, 3, ball(0)), message(1, 2, ball(0))]],
  ['has a link before its parent', [message(0, 2, link(1), link(0))]],
  ['has a link that is its own parent', [message(0, 1, link(1))]],
  ['has a shape of a link that does not exist', [message(0, 2, link(0), ball(2))]],
  ['has a link after a shape', [message(0, 2, ball(0), link(0))]],
])('a model that %s is not taken', (_, messages) => {
  model.takeParts(message(0, 1, ball(0)));
  for (const each of messages) expect(model.takeParts(each)).toBe(false);
  expect(model.changes).toBe(1);
  expect(model.shapes).toHaveLength(1);
});

test('the newest positions count, if they belong to the model', () => {
  model.takeParts(message(0, 2, link(0), ball(1)));
  expect(model.positions).toEqual([0]);
  expect(model.jointsAgeMs(0)).toBe(null);
  expect(model.takeJoints(joints(100, 1), 200)).toBe(true);
  expect(model.takeJoints(joints(50, 2), 210)).toBe(false);
  expect(model.takeJoints(joints(150, 1, 2), 220)).toBe(false);
  expect(model.takeJoints({ ...joints(150, 2), model: 2 }, 220)).toBe(false);
  expect(model.positions).toEqual([1]);
  expect(model.jointsAgeMs(300)).toBe(105);
});

const MESHES: ModelMeshes = {
  insteadOf: [0],
  meshes: [
    {
      ...{ min: [0, 0, 0], step: 0.0009765625, vertices: Uint16Array.of(0, 0, 0, 9, 0, 0, 0, 9, 0) },
      triangles: Uint16Array.of(0, 1, 2),
    },
  ],
  drawings: [{ mesh: 0, link: 1, place: [0, 0, 0, 0, 0, 0, 1], colour: 7 }],
};

/** In messages of 30 bytes. */
function meshMessages(meshes: ModelMeshes | Uint8Array, of = 1): ModelMeshParts[] {
  const bytes = meshes instanceof Uint8Array ? meshes : encodeModelMeshes(meshes);
  return Array.from({ length: Math.ceil(bytes.length / 30) }, (_, i) => ({
    ...{ type: 'modelMeshes', model: of, count: bytes.length, at: 30 * i },
    data: Buffer.from(bytes.subarray(30 * i, 30 * i + 30)).toString('base64'),
  }));
}

test('meshes are known when all of them have come, and go with their model', () => {
  model.takeParts(message(0, 2, link(0), ball(1)));
  const messages = meshMessages(MESHES);
  expect(messages.map((each) => model.takeMeshes(each))).toEqual(
    messages.map((_, i) => i === messages.length - 1),
  );
  expect(model.meshes).toEqual(MESHES);
  expect(model.changes).toBe(2);
  model.takeParts(message(0, 1, ball(0)));
  expect(model.meshes).toBe(null);
});

test('meshes of another model, with a gap, or from before the model are not taken', () => {
  const [first, second, ...rest] = meshMessages(MESHES);
  expect(model.takeMeshes(first!)).toBe(false);
  model.takeParts(message(0, 2, link(0), ball(1)));
  for (const each of meshMessages(MESHES, 2)) expect(model.takeMeshes(each)).toBe(false);
  for (const each of [first!, ...rest, second!]) expect(model.takeMeshes(each)).toBe(false);
  for (const each of [first!, second!, { ...rest[0]!, count: 9000 }])
    expect(model.takeMeshes(each)).toBe(false);
  expect(model.meshes).toBe(null);
});

test.each<[string, ModelMeshes | Uint8Array]>([
  ['are no meshes', new Uint8Array(100)],
  ['are of a link that the model has not', { ...MESHES, drawings: [{ ...MESHES.drawings[0]!, link: 2 }] }],
  ['stand for a shape that the model has not', { ...MESHES, insteadOf: [0, 1] }],
])('meshes that %s are refused, and the model stays as it was', (_, meshes) => {
  model.takeParts(message(0, 2, link(0), ball(1)));
  expect(() => {
    for (const each of meshMessages(meshes)) model.takeMeshes(each);
  }).toThrow(ProtocolError);
  expect(model.meshes).toBe(null);
  expect(model.shapes).toHaveLength(1);
});
