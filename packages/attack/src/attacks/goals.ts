import type { SignaledOperator } from '@farpoint/robot-node/testing';
import { attacks } from '../attack.ts';
import { inTime, mustHold, pause } from '../harm.ts';
import { Noise } from '../noise.ts';
import type { Scene } from '../scene.ts';

type Client = SignaledOperator['client'];

/** From a second operator of the driven robot, which must not have taken any goal afterwards. */
function withGuest(act: (client: Client, scene: Scene) => unknown) {
  return async (scene: Scene): Promise<void> => {
    const { client } = await scene.guest();
    await act(client, scene);
    await pause(200);
    mustHold((await scene.metric('farpoint_robot_goals_taken_total')) === 0, 'the robot took a goal');
  };
}

const goal = (change: object) =>
  ({ type: 'goal', id: 1, timeMs: performance.now(), lease: 'x'.repeat(22), x: 1, y: 0, ...change }) as never;
const hold = (change: object) =>
  JSON.stringify({
    ...{ type: 'goalHold', goal: 1, sequence: 1, timeMs: performance.now(), lease: 'x'.repeat(22) },
    ...change,
  });

async function expectRefused(client: Client, reason: string): Promise<void> {
  await inTime(
    client.message('goalState', (each) => each.state === 'refused' && each.reason === reason),
    `a goal was not refused as ${reason}`,
  );
}

/** Goals, from an operator that does not drive and wants the robot to go elsewhere. */
export const goalAttacks = attacks('session', {
  'goal with an invented lease': withGuest(async (client) => {
    client.sendSession(goal({}));
    await expectRefused(client, 'not-lease-holder');
  }),
  'goal with the driver’s lease': withGuest(async (client, { driver }) => {
    client.sendSession(goal({ lease: driver.lease }));
    await expectRefused(client, 'not-lease-holder');
    for (let sequence = 0; sequence < 20; sequence++)
      client.control.send(hold({ lease: driver.lease, sequence: 2 ** 31 + sequence, seenUs: 0 }));
    await inTime(client.message('rejected'), 'a hold without the lease was not rejected');
  }),
  'goals at places that are none': withGuest((client, { driver }) => {
    const { lease } = driver;
    for (const x of [null, 'NaN', 1e308, -1e308, [], {}, true]) client.sendSession(goal({ lease, x }));
    for (const yaw of [null, 99, '0', 1e308]) client.sendSession(goal({ lease, yaw }));
    client.sendSession(goal({ lease, frame: 'map' }));
  }),
  'five hundred goals at once': withGuest(async (client, { driver }) => {
    for (let id = 0; id < 500; id++) client.sendSession(goal({ id, lease: driver.lease }));
    await expectRefused(client, 'rate-limited');
  }),
  'takes back the goals of others': withGuest((client) => {
    for (const id of [0, 1, 2 ** 32 - 1]) client.sendSession({ type: 'goalCancel', id });
  }),
  'damaged holds of a goal': withGuest((client, { driver }) => {
    const noise = new Noise(9);
    for (let n = 0; n < 300; n++) {
      const text = Buffer.from(hold({ sequence: n, lease: driver.lease }));
      for (let changes = 1 + noise.below(3); changes > 0; changes--)
        text[noise.below(text.length)] = noise.below(128);
      client.control.send(text.toString('latin1'));
    }
  }),
});
