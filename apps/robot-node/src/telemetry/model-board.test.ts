import { encodeJson, type ModelPart, robotSessionCodec } from '@farpoint/protocol';
import { type LinkMeshes, modelReading, newsOf } from '@farpoint/ros';
import { beforeEach, expect, test } from 'vitest';
import { type LoadMeshes, ModelBoard } from './model-board.ts';

const JOINTS = 30;
const links = Array.from(
  { length: JOINTS },
  (_, i) =>
    `<link name="l${i}"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
     <joint name="j${i}" type="continuous"><parent link="base_link"/><child link="l${i}"/></joint>`,
).join('');
const ARM = `<robot name="r"><link name="base_link"/>${links}</robot>`;
const SMALL =
  '<robot name="r"><link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link></robot>';
const reading = (urdf: string) => modelReading('/robot_description', undefined, newsOf(urdf));
const joints = (...positions: [string, number][]) => ({
  ...{ topic: '/joint_states', label: 'Joints', level: 'ok' as const, values: [], joints: positions },
});

let board: ModelBoard;
const operator = {};
beforeEach(() => {
  board = new ModelBoard();
});

/** What this operator knows of the model after so many seconds. @returns the number of messages */
function told(model: ModelPart[], width: 'wide' | 'narrow', fromMs: number, seconds: number): number {
  let messages = 0;
  for (let nowMs = fromMs; nowMs < fromMs + seconds * 1000; nowMs += 50) {
    const parts = board.nextParts(operator, width, nowMs);
    if (parts === null) continue;
    messages++;
    expect(encodeJson(robotSessionCodec, parts).length).toBeLessThan(1100);
    expect(parts.at).toBe(parts.at === 0 ? 0 : model.length);
    model.splice(parts.at, model.length, ...parts.parts);
    expect(model.length).toBeLessThanOrEqual(parts.count);
  }
  return messages;
}

test('a model is told once, in small messages one after another, and slowly to a narrow path', () => {
  board.take(reading(ARM), 0);
  const model: ModelPart[] = [];
  const first = told(model, 'wide', 0, 1);
  expect(model.map(({ part }) => part)).toEqual([
    ...new Array(JOINTS).fill('link'),
    ...new Array(JOINTS).fill('shape'),
  ]);
  expect(told(model, 'wide', 1000, 10)).toBe(0);
  board.take(reading(ARM), 11_000);
  expect(told([], 'narrow', 11_000, 2)).toBe(5);
  expect(first).toBeGreaterThan(5);
});

test('a new model takes the place of the old, and one that cannot be read removes it', () => {
  const model: ModelPart[] = [];
  expect(board.nextParts(operator, 'wide', 0)).toBe(null);
  board.take(reading(ARM), 0);
  board.nextParts(operator, 'wide', 0);
  board.take(reading(SMALL), 100);
  told(model, 'wide', 100, 1);
  expect(model).toHaveLength(1);
  board.take(reading('<robot>'), 2000);
  expect(told(model, 'wide', 2000, 1)).toBe(1);
  expect(model).toEqual([]);
  expect(board.reading(2000)?.values[0]?.[1]).toMatch(/not closed/);
});

test('joints are told when they have moved, else once a second, to those who know the model', () => {
  board.take(reading(ARM), 0);
  board.take(joints(['j1', 7], ['j2', -0.25], ['other', 1]), 10);
  expect(board.nextJoints(operator, 10)).toBe(null);
  const model: ModelPart[] = [];
  told(model, 'wide', 0, 1);
  const message = board.nextJoints(operator, 1000);
  expect(message).toMatchObject({ timeMs: 10, ageMs: 990 });
  expect(message?.positions.slice(0, 3)).toEqual([0, 0.7168, -0.25]);
  expect(message?.positions).toHaveLength(JOINTS);
  board.take(joints(['j1', 7]), 1050);
  expect(board.nextJoints(operator, 1050)).toBe(null);
  board.take(joints(['j1', 7.5]), 1100);
  expect(board.nextJoints(operator, 1100)?.positions[1]).toBe(1.2168);
  expect(board.nextJoints(operator, 2050)).toBe(null);
  expect(board.nextJoints(operator, 2100)).not.toBe(null);
});

test('people are told when joints are unknown or silent, and when that is over', () => {
  board.take(reading(SMALL), 0);
  expect(board.reading(60_000)).toBe(null);
  board.take(reading(ARM), 0);
  expect(board.reading(2000)).toBe(null);
  expect(board.reading(4000)).toMatchObject({ level: 'warn', values: [['', 'its joints are unknown']] });
  board.take(joints(['j1', 1]), 5000);
  expect(board.reading(5000)).toMatchObject({ level: 'ok', values: [['', 'drawn']] });
  expect(board.reading(15_000)?.values).toEqual([['', 'its joints: silent for 10 s']]);
});

const MESHED = `<robot name="r"><link name="base_link"><visual><geometry><mesh filename="a.stl"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>`;

test('meshes come after the model, in small messages, and not while others wait for the path', () => {
  const bytes = Uint8Array.from({ length: 2000 }, (_, i) => i);
  let links: readonly LinkMeshes[] = [];
  board.loadMeshes = (given, done) => {
    links = given;
    done({ bytes, left: { replaced: 0, missing: 0, why: null } });
  };
  board.take(reading(MESHED), 0);
  expect(links).toMatchObject([{ meshes: [{ address: 'a.stl' }], standIns: [0] }]);
  expect(board.nextMeshes(operator, 'wide', 0, 0)).toBe(null);
  told([], 'wide', 0, 1);
  expect(board.nextMeshes(operator, 'wide', 10_000, 1000)).toBe(null);
  const taken: number[] = [];
  let messages = 0;
  for (let nowMs = 1000; nowMs < 3000; nowMs += 25) {
    const part = board.nextMeshes(operator, 'wide', 0, nowMs);
    if (part === null) continue;
    expect(encodeJson(robotSessionCodec, part).length).toBeLessThan(1100);
    expect(part).toMatchObject({ model: 1, count: 2000, at: taken.length });
    taken.push(...Buffer.from(part.data, 'base64'));
    messages++;
  }
  expect(taken).toEqual([...bytes]);
  expect(messages).toBe(3);
  // Another operator gets them from the beginning, slowly on a narrow path.
  const other = {};
  for (let nowMs = 5000; nowMs < 7000; nowMs += 50) board.nextParts(other, 'narrow', nowMs);
  expect(board.nextMeshes(other, 'narrow', 0, 7000)?.at).toBe(0);
  expect(board.nextMeshes(other, 'narrow', 0, 7350)).toBe(null);
  expect(board.nextMeshes(other, 'narrow', 0, 7400)?.at).toBe(720);
});

test('people are told of the meshes that are not drawn, once it is known', () => {
  let done: Parameters<LoadMeshes>[1] = () => undefined;
  board.loadMeshes = (_, then) => {
    done = then;
  };
  board.take(reading(MESHED), 0);
  expect(board.reading(0)?.values).toEqual([['', 'collision shapes for 1 mesh']]);
  done({ bytes: null, left: { replaced: 1, missing: 0, why: 'a.stl: no folder for meshes has it' } });
  expect(board.reading(0)?.values).toEqual([
    ['', 'collision shapes for 1 mesh'],
    ['', 'a.stl: no folder for meshes has it'],
  ]);
  done({ bytes: new Uint8Array(1), left: { replaced: 0, missing: 0, why: null } });
  expect(board.reading(0)).toMatchObject({ level: 'ok', values: [['', 'drawn']] });
});
