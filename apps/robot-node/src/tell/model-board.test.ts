import { encodeJson, type ModelPart, robotSessionCodec } from '@farpoint/protocol';
import { modelReading, newsOf } from '@farpoint/ros';
import { beforeEach, expect, test } from 'vitest';
import { ModelBoard } from './model-board.ts';

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
