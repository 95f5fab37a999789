import type { RobotClient } from '@farpoint/operator';
import { signal } from '@preact/signals-core';
import { expect, test } from 'vitest';
import { hazardsOf, showHazards } from './show-hazards.ts';

type Session = RobotClient['link']['session'];

const heights = { clearanceM: 0.04, heightM: 1.1, dropM: 0.15, slope: 0.01 };
const footprint = [
  { x: 0.35, y: -0.25 },
  { x: 0.35, y: 0.25 },
  { x: -0.3, y: 0.25 },
  { x: -0.3, y: -0.25 },
];
const pose = { position: { x: 1, y: 2, z: 0.1 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const session = {
  welcome: { body: { footprint, decelerationMps2: 2, heights } },
  telemetry: { pose },
} as unknown as Pick<Session, 'welcome' | 'telemetry'>;

test('what the robot says of itself and where it is give the hazards', () => {
  const hazards = hazardsOf(session);
  expect(hazards).toMatchObject({ ...heights, ...pose });
  expect(hazards?.ownM).toBeCloseTo(0.2);
});

test.each([
  ['no pose', { ...session, telemetry: null }],
  ['no welcome', { ...session, welcome: null }],
  ['no body', { ...session, welcome: {} }],
  ['no heights', { ...session, welcome: { body: { footprint, decelerationMps2: 2 } } }],
])('nothing is guessed: %s', (_, known) => {
  expect(hazardsOf(known as unknown as typeof session)).toBe(null);
});

test('every cloud follows the switch and the pose', () => {
  const listeners: (() => void)[] = [];
  const link = { session: { ...session } };
  const client = { link, on: (_: string, listener: () => void) => listeners.push(listener) };
  const [first, second] = [{ colouring: { hazards: null } }, { colouring: { hazards: null } }];
  const clouds = { all: signal([first]) };
  const appearance = { hazards: signal(false) };
  showHazards({ client, clouds, appearance } as unknown as Parameters<typeof showHazards>[0]);
  expect(first.colouring.hazards).toBe(null);
  appearance.hazards.value = true;
  expect(first.colouring.hazards).toMatchObject(pose);
  clouds.all.value = [first, second];
  expect(second.colouring.hazards).toMatchObject(pose);
  // Another session: nothing is known of the robot.
  link.session = { ...session, telemetry: null };
  for (const listener of listeners) listener();
  expect([first.colouring.hazards, second.colouring.hazards]).toEqual([null, null]);
});
