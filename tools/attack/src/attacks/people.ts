import type { SignaledOperator } from '@farpoint/robot-node/testing';
import { attacks } from '../attack.ts';
import { inTime, mustHold, pause } from '../harm.ts';
import type { Scene } from '../scene.ts';

type Client = SignaledOperator['client'];

/** From a second operator of the driven robot, to which the drive must not have been handed afterwards. */
function withGuest(act: (client: Client, scene: Scene) => unknown) {
  return async (scene: Scene): Promise<void> => {
    const { client } = await scene.guest();
    await act(client, scene);
    await pause(200);
    for (const kind of ['ask', 'offer']) {
      const accepted = await scene.metric('farpoint_robot_handovers_total', `{outcome="${kind}-accepted"}`);
      mustHold(accepted === 0, 'the robot has handed the drive over');
    }
  };
}

async function expectRefused(client: Client, reason: string): Promise<void> {
  await inTime(
    client.message('fault', (each) => each.reason === reason),
    `a request was not refused as ${reason}`,
  );
}

/** The guest's own number, and the driver's. */
async function numbers(client: Client): Promise<{ own: number; driver: number }> {
  const { operators } = await inTime(
    client.message('operators', (list) => list.operators.some(({ drives }) => drives)),
    'the robot does not say who drives',
  );
  const numberOf = (is: (each: (typeof operators)[number]) => boolean) => operators.find(is)?.number ?? 0;
  return { own: numberOf(({ you }) => you), driver: numberOf(({ drives }) => drives) };
}

const answer = (id: number) => ({ type: 'driveAnswer', id, accept: true }) as const;

/** Requests for the drive and offers of it, from an operator that does not drive and wants to. */
export const peopleAttacks = attacks('session', {
  'gives itself the drive that it has asked for': withGuest(async (client) => {
    client.sendSession({ type: 'driveAsk' });
    const { id } = await inTime(client.message('handover'), 'the driver was not asked');
    client.sendSession(answer(id));
    await expectRefused(client, 'not-open');
    client.sendSession({ type: 'driveWithdraw', id });
    client.sendSession(answer(id));
  }),
  'offers itself a drive that it does not have': withGuest(async (client) => {
    const { own, driver } = await numbers(client);
    for (const to of [own, driver, 0, 2 ** 32 - 1]) client.sendSession({ type: 'driveOffer', to });
    await expectRefused(client, 'not-driver');
  }),
  'answers requests that nobody has made': withGuest(async (client) => {
    for (let id = 0; id < 150; id++) client.sendSession(answer(id));
    client.sendSession(answer(2 ** 32 - 1));
    await expectRefused(client, 'not-open');
  }),
  'requests for the drive that are none': withGuest(async (client) => {
    for (const to of [-1, 2 ** 32, 0.5, '1', null, {}, [1]])
      client.sendSession({ type: 'driveOffer', to } as never);
    for (const id of [-1, 2 ** 32, '1', null]) client.sendSession({ ...answer(0), id } as never);
    client.sendSession({ type: 'driveAsk', from: 1, lease: 'x' } as never);
    await inTime(client.message('fault'), 'what is no request was not refused');
  }),
  'five hundred requests for the drive at once': withGuest(async (client) => {
    for (let n = 0; n < 500; n++)
      client.sendSession(n % 2 === 0 ? { type: 'driveAsk' } : { type: 'driveOffer', to: 1 });
    await expectRefused(client, 'rate-limited');
  }),
});
