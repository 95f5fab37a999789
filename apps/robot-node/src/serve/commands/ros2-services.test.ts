import { MemoryServiceGraph } from '@farpoint/ros/testing';
import { expect, it } from 'vitest';
import type { CallAction } from './command-configuration.ts';
import { Ros2Services } from './ros2-services.ts';

const charge: CallAction = { kind: 'call', service: '/charge', type: 'std_srvs/Trigger', data: false };
const horn: CallAction = { kind: 'call', service: '/horn', type: 'std_srvs/SetBool', data: true };

function bench() {
  const graph = new MemoryServiceGraph(() => 0);
  return { graph, services: new Ros2Services(graph, [charge, horn, charge]) };
}

it('have one client each from the start', () => {
  expect(bench().graph.clients).toEqual([
    { service: '/charge', request: 'std_srvs/srv/Trigger_Request', reply: 'std_srvs/srv/Trigger_Response' },
    { service: '/horn', request: 'std_srvs/srv/SetBool_Request', reply: 'std_srvs/srv/SetBool_Response' },
  ]);
});

it('are called as configured, and their answer is told', async () => {
  const { graph, services } = bench();
  const on = services.call(horn, 1500);
  expect(graph.calls[0]).toMatchObject({ service: '/horn', withinMs: 1500 });
  expect([...(graph.calls[0]?.request ?? [])]).toEqual([0, 1, 0, 0, 1]);
  graph.calls[0]?.reply(Uint8Array.of(0, 1, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 111, 107, 0));
  expect(await on).toEqual({ state: 'done', detail: 'ok' });
  const no = services.call(charge, 1500);
  graph.calls[1]?.reply(Uint8Array.of(0, 1, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 110, 111, 0));
  expect(await no).toEqual({ state: 'failed', detail: 'no' });
});

it('that are not configured are not called', async () => {
  const { graph, services } = bench();
  const result = await services.call({ ...charge, service: '/other' }, 1500);
  expect(result).toEqual({ state: 'failed', detail: '/other is not configured' });
  expect(graph.calls).toEqual([]);
});

it('fail where the answer is none', async () => {
  const { graph, services } = bench();
  const reply = services.call(charge, 1500);
  graph.calls[0]?.reply(Uint8Array.of(0, 1, 0, 0, 2));
  await expect(reply).rejects.toMatchObject({ code: 'bad-message' });
});
