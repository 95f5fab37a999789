import type { SignaledOperator } from '@farpoint/robot-node/testing';
import { attacks } from '../attack.ts';
import { inTime, mustHold, pause } from '../harm.ts';
import type { Scene } from '../scene.ts';

type Client = SignaledOperator['client'];

/** From a second operator of the driven robot, for whom it must not have begun any of its driver's commands afterwards. */
function withGuest(act: (client: Client) => unknown) {
  return async (scene: Scene): Promise<void> => {
    const { client } = await scene.guest();
    await act(client);
    await pause(200);
    for (const command of ['lights', 'self-test']) {
      const begun = await scene.metric('farpoint_robot_command_calls_total', `{command="${command}"}`);
      mustHold(begun === 0, 'the robot did a command of its driver');
    }
  };
}

const call = (change: object) =>
  ({ type: 'callCommand', id: 'lights', request: 1, timeMs: performance.now(), ...change }) as never;

async function expectRefused(client: Client, reason: string): Promise<void> {
  await inTime(
    client.message('commandRefused', (each) => each.reason === reason),
    `a command was not refused as ${reason}`,
  );
}

/** Robot commands, from an operator that does not drive, and commands that the robot does not have. */
export const robotCommandAttacks = attacks('session', {
  'robot commands of the driver': withGuest(async (client) => {
    client.sendSession(call({}));
    client.sendSession(call({ id: 'self-test', request: 2 }));
    await expectRefused(client, 'not-driver');
  }),
  'robot commands that are not configured': withGuest(async (client) => {
    for (const [n, id] of ['dock', 'constructor', '0', 'a'.repeat(32)].entries())
      client.sendSession(call({ id, request: n + 1 }));
    await expectRefused(client, 'unknown');
  }),
  'robot commands that name topics, types and values': withGuest(async (client) => {
    for (const id of ['/cmd_vel', '../lights', '__proto__', '', 'a'.repeat(33), null, {}, ['lights']])
      client.sendSession(call({ id }));
    for (const more of [
      { topic: '/cmd_vel' },
      { service: '/x' },
      { message: { data: true } },
      { lease: 'x' },
    ])
      client.sendSession(call(more));
    for (const request of [-1, 2 ** 32, 0.5, '1', null]) client.sendSession(call({ request }));
    await inTime(client.message('fault'), 'what is no command was not refused');
  }),
  'texts that are too long, or that are none': withGuest(async (client) => {
    for (const text of ['x'.repeat(121), 'x'.repeat(5000), 'a\nb', 'a\u202eb', '', 7])
      client.sendSession(call({ id: 'horn', text }));
    await inTime(client.message('fault'), 'what is no text was not refused');
    client.sendSession(call({ id: 'horn', request: 2, text: 'to everybody' }));
    await expectRefused(client, 'no-text');
  }),
  'the same robot command again and again': withGuest(async (client) => {
    for (let n = 0; n < 5; n++) client.sendSession(call({ id: 'horn', request: 7 }));
    await expectRefused(client, 'repeated');
  }),
  'five hundred robot commands at once': withGuest(async (client) => {
    for (let request = 0; request < 500; request++) client.sendSession(call({ id: 'horn', request }));
    await expectRefused(client, 'too-often');
  }),
  'cancelling what others run, and what does not run': withGuest(async (client) => {
    for (const run of [0, 1, 2, 2 ** 32 - 1]) client.sendSession({ type: 'cancelCommand', run });
    for (const run of [-1, 0.5, '1', null]) client.sendSession({ type: 'cancelCommand', run } as never);
    await expectRefused(client, 'unknown');
  }),
});
