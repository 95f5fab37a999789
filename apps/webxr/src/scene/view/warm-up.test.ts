import { Camera, Group, Mesh, type Object3D, Scene } from 'three';
import { expect, test } from 'vitest';
import { warmUp } from './warm-up.ts';

test('what is hidden or beside the picture is drawn, and then as it was', () => {
  const scene = new Scene();
  const [group, inside, shown] = [new Group(), new Mesh(), new Mesh()];
  group.visible = false;
  inside.visible = false;
  shown.frustumCulled = false;
  scene.add(group.add(inside), shown);
  const drawn: Object3D[] = [];
  const render = () =>
    scene.traverse((object) => {
      if (object.visible && !object.frustumCulled) drawn.push(object);
    });
  warmUp({ render }, scene, new Camera());
  expect(drawn).toEqual([scene, group, inside, shown]);
  expect([group.visible, inside.visible, shown.visible]).toEqual([false, false, true]);
  expect([inside.frustumCulled, shown.frustumCulled]).toEqual([true, false]);
});

test('a picture that fails leaves nothing shown that was hidden', () => {
  const scene = new Scene();
  const hidden = new Mesh();
  hidden.visible = false;
  scene.add(hidden);
  const render = () => {
    throw new Error('context lost');
  };
  expect(() => warmUp({ render }, scene, new Camera())).toThrow('context lost');
  expect(hidden.visible).toBe(false);
});
