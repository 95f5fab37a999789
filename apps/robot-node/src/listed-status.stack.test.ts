/** What the list says of real robots, to an operator that has no session with any. */
import { once } from 'node:events';
import { LocalStack } from '@farpoint/local-stack';
import {
  applyStatusesChanged,
  decodeJson,
  type OperatorToService,
  type RobotStatus,
  serviceToOperatorCodec,
} from '@farpoint/protocol';
import { afterAll, afterEach, beforeAll, expect, it } from 'vitest';
import { WebSocket } from 'ws';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ARGS = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600', '--sim-charge', '42'];
const robots = (['state', 'names', 'off'] as const).map((level) => ({
  id: level,
  name: `Says ${level}`,
  args: [...ARGS, '--list-status', level],
}));

let stack: LocalStack;
const cleanups: (() => Promise<void> | void)[] = [];
beforeAll(async () => {
  stack = await LocalStack.start({ robots });
}, 60_000);
afterAll(() => stack.stop(), 30_000);
afterEach(async () => {
  for (const cleanup of cleanups.splice(0).reverse()) await cleanup();
});

/** An operator that looks at the list. */
async function watcher() {
  const socket = new WebSocket(new URL('/operator', stack.signalingUrl));
  cleanups.push(() => socket.terminate());
  await once(socket, 'open');
  let statuses: ReadonlyMap<string, RobotStatus> = new Map();
  let look = () => {};
  socket.on('message', (data) => {
    const message = decodeJson(serviceToOperatorCodec, data.toString());
    if (message.type === 'statuses')
      statuses = new Map(message.statuses.map(({ id, status }) => [id, status]));
    else if (message.type === 'statuses.changed') statuses = applyStatusesChanged(statuses, message);
    look();
  });
  const send = (message: OperatorToService) => socket.send(JSON.stringify(message));
  send({ type: 'operator.hello', protocol: 1, name: 'Looks' });
  send({ type: 'statuses.watch', on: true });
  const until = (is: (of: ReadonlyMap<string, RobotStatus>) => boolean) =>
    new Promise<ReadonlyMap<string, RobotStatus>>((resolve) => {
      look = () => {
        if (is(statuses)) resolve(statuses);
      };
      look();
    });
  return { until };
}

it('says of each robot as much as it is to, and what changes', { timeout: 60_000 }, async () => {
  const { until } = await watcher();
  const first = await until((of) => of.get('state')?.battery !== undefined && of.get('names') !== undefined);
  expect(first.get('state')).toMatchObject({ state: 'free', operators: 0, watchers: 0 });
  expect(first.get('state')?.version).toMatch(/^\d+\.\d+\.\d+/);
  expect(first.get('state')?.battery).toBeCloseTo(0.42, 1);
  for (const id of ['state', 'names']) {
    const operator = await SignaledOperator.connect(stack.signalingUrl, id);
    cleanups.push(() => operator.close());
    const { client } = operator;
    await client.takeLease();
    const driven = await until((of) => of.get(id)?.state === 'driven' && of.get(id)?.operators === 1);
    expect(driven.get(id)?.driver).toBe(id === 'names' ? 'test operator' : undefined);
    client.sendSession({ type: 'estop', latch: true });
    await until((of) => of.get(id)?.state === 'stopped');
  }
  const last = await until((of) => of.get('names')?.state === 'stopped');
  expect(last.has('off')).toBe(false);
  await stack.robot('state').kill();
  await until((of) => !of.has('state'));
});
