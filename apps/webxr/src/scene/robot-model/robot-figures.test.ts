/** What is drawn of the robot's model, where, and when it is hidden. */
import { RobotModel } from '@farpoint/operator';
import type { ModelPart } from '@farpoint/protocol';
import { Group, type Mesh, PerspectiveCamera, Vector3 } from 'three';
import { beforeEach, expect, test } from 'vitest';
import { RobotFigures } from './robot-figures.ts';

const HALF = Math.SQRT1_2;
/** A base of 0.4 × 0.4 × 0.2 m on the floor; on it an arm that turns about z, and a finger that slides along it. */
const parts: ModelPart[] = [
  { part: 'link', parent: 0, place: [0, 0, 0.2, 0, 0, 0, 1], moves: 'turns', axis: [0, 0, 1] },
  { part: 'link', parent: 1, place: [0.3, 0, 0, 0, 0, HALF, HALF], moves: 'slides', axis: [0, -1, 0] },
  {
    part: 'shape',
    link: 0,
    place: [0, 0, 0.1, 0, 0, 0, 1],
    form: 'box',
    size: [0.4, 0.4, 0.2],
    colour: 0xff0000,
  },
  {
    part: 'shape',
    link: 1,
    place: [0.15, 0, 0, 0, HALF, 0, HALF],
    form: 'cylinder',
    size: [0.02, 0.3],
    colour: 0,
  },
  { part: 'shape', link: 2, place: [0, 0, 0, 0, 0, 0, 1], form: 'sphere', size: [0.03], colour: 0xffffff },
];

let model: RobotModel;
let [body, ghost, world] = [new Group(), new Group(), new Group()];
let figures: RobotFigures;
beforeEach(() => {
  model = new RobotModel();
  model.takeParts({ type: 'robotModel', number: 1, count: parts.length, at: 0, parts });
  [body, ghost, world] = [new Group(), new Group(), new Group()];
  world.add(body, ghost);
  figures = new RobotFigures(body, ghost, world);
});

function meshesIn(object: Group): Mesh[] {
  const found: Mesh[] = [];
  object.traverse((each) => {
    if ('isMesh' in each) found.push(each as Mesh);
  });
  return found;
}

/** The middle of a link's shapes in the world. */
function middleOf(mesh: Mesh): number[] {
  world.updateMatrixWorld(true);
  const middle = mesh.geometry.boundingBox?.getCenter(new Vector3()) ?? new Vector3();
  return middle
    .applyMatrix4(mesh.matrixWorld)
    .toArray()
    .map((n) => Math.round(n * 1000) / 1000 + 0);
}

function cameraAt(x: number, y: number, z: number): PerspectiveCamera {
  const camera = new PerspectiveCamera();
  camera.position.set(x, y, z);
  return camera;
}

test('links stand where their joints are', () => {
  figures.show(model);
  const meshes = meshesIn(body);
  expect(meshes.map((mesh) => middleOf(mesh))).toEqual([
    [0, 0, 0.1],
    [0.15, 0, 0.2],
    [0.3, 0, 0.2],
  ]);
  model.takeJoints({ type: 'joints', model: 1, timeMs: 1, ageMs: 0, positions: [Math.PI / 2, 0.1] }, 0);
  figures.show(model);
  expect(meshesIn(body).map((mesh) => middleOf(mesh))).toEqual([
    [0, 0, 0.1],
    [0, 0.15, 0.2],
    [0, 0.4, 0.2],
  ]);
  body.position.set(5, 0, 0);
  expect(middleOf(meshesIn(body)[2] as Mesh)).toEqual([5, 0.4, 0.2]);
  expect(middleOf(meshesIn(ghost)[2] as Mesh)).toEqual([0, 0.4, 0.2]);
});

test('shapes have their size and their colour', () => {
  figures.show(model);
  const [base, arm] = meshesIn(body) as [Mesh, Mesh];
  expect(base.geometry.boundingBox?.max.toArray().map((n) => Math.round(n * 100) / 100)).toEqual([
    0.2, 0.2, 0.2,
  ]);
  expect([...(base.geometry.getAttribute('color').array as Float32Array).slice(0, 3)]).toEqual([1, 0, 0]);
  expect(Math.round((arm.geometry.boundingBox?.max.x ?? 0) * 100) / 100).toBe(0.3);
});

test('it is not drawn from the robot’s own eyes, nor while the eyes are inside it', () => {
  figures.place(false, cameraAt(2, 2, 2));
  expect(figures.shown.drawn).toBe(false);
  figures.show(model);
  figures.place(false, cameraAt(2, 2, 2));
  expect(figures.shown).toEqual({ links: 2, shapes: 3, positions: [0, 0], drawn: true });
  figures.place(true, cameraAt(2, 2, 2));
  expect(figures.shown.drawn).toBe(false);
  figures.place(false, cameraAt(0.1, 0, 0.25));
  expect(figures.shown.drawn).toBe(false);
  body.position.set(3, 0, 0);
  figures.place(false, cameraAt(0.1, 0, 0.25));
  expect(figures.shown.drawn).toBe(true);
});

test('a model that is gone is not drawn, and joints alone build nothing', () => {
  figures.show(model);
  const [before] = meshesIn(body);
  model.takeJoints({ type: 'joints', model: 1, timeMs: 1, ageMs: 0, positions: [1, 0] }, 0);
  figures.show(model);
  expect(meshesIn(body)[0]).toBe(before);
  expect(figures.known).toBe(true);
  figures.show(null);
  expect(figures.known).toBe(false);
  expect(meshesIn(body)).toEqual([]);
});
