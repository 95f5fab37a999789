import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { expect, test } from 'vitest';
import { toModel } from './robot-options.ts';
import type { RobotOptionValues } from './robot-program.ts';

const SMALL =
  '<robot name="r"><link name="a"><visual><geometry><sphere radius="1"/></geometry></visual></link></robot>';

/** A file with this text. */
function fileOf(text: string): string {
  const path = join(testFolder(), 'robot.urdf');
  writeFileSync(path, text);
  return path;
}

function modelOf(values: Partial<RobotOptionValues>) {
  const refused: string[] = [];
  const given = {
    urdf: null,
    source: 'sim',
    simLidars: 0,
    topics: [],
    ...values,
  } as unknown as RobotOptionValues;
  const reading = toModel(given, (key, detail) => refused.push(`${key}: ${detail}`));
  const model = reading?.model?.kind === 'model' ? reading.model.model : null;
  return { model, refused };
}

test('the simulated robot has one of its own: a base, a mast with a camera, two wheels that turn', () => {
  for (const simLidars of [0, 1]) {
    const { model, refused } = modelOf({ simLidars });
    expect(refused).toEqual([]);
    expect(model?.joints.map(({ name }) => name)).toEqual(['left_wheel_joint', 'right_wheel_joint']);
    expect(model?.meshes).toEqual({ replaced: 0, missing: 0 });
    expect(model?.parts.filter(({ part }) => part === 'shape')).toHaveLength(10 + simLidars);
  }
});

test('others have one only if a file is named, and the simulated robot can have another or none', () => {
  expect(modelOf({ source: 'ros2' }).model).toBe(null);
  expect(modelOf({ source: 'ros2', urdf: fileOf(SMALL) }).model?.parts).toHaveLength(1);
  expect(modelOf({ urdf: fileOf(SMALL) }).model?.parts).toHaveLength(1);
  expect(modelOf({ urdf: 'none' })).toEqual({ model: null, refused: [] });
});

test('a file that cannot be used is refused with what is wrong', () => {
  expect(modelOf({ urdf: '/nowhere/robot.urdf' }).refused).toEqual([
    expect.stringMatching(/^urdf: cannot be read: /),
  ]);
  const path = fileOf('<!DOCTYPE r [<!ENTITY x "y">]><robot/>');
  expect(modelOf({ urdf: path }).refused).toEqual([
    `urdf: ${path}: line 1: its document type defines something`,
  ]);
  const topics = [{ topic: '/robot_description', as: 'model' }] as RobotOptionValues['topics'];
  expect(modelOf({ urdf: fileOf(SMALL), source: 'ros2', topics }).refused).toHaveLength(1);
});
