/** What the real robot program tells about itself: quantities, samples, components, alarms. */
import { expect, it } from 'vitest';
import { useRobot } from './testing/use-robot.ts';

const robot = useRobot('sim-1', [
  ...['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'],
  ...['--sim-charge', '15', '--sim-origin', '48.1374,11.5755'],
]);

it('describes its quantities, samples them, reports its components and raises an alarm', async () => {
  const { client } = await robot.connect();
  expect(await client.message('alarm')).toMatchObject({ level: 'warn', limit: 20, unit: '%' });
  await client.until(() => client.newest.diagnostics !== undefined && client.samples.length >= 10);
  const quantities = client.session.filter((message) => message.type === 'quantity');
  expect(quantities.map(({ topic, field }) => `${topic} ${field}`)).toEqual([
    ...['/motors left', '/motors right', '/fix latitude', '/fix longitude', '/fix altitude'],
  ]);
  const newest = new Map(client.samples.map(([number, , value]) => [number, value]));
  expect(newest.get(0)).toBeCloseTo(22, 0);
  expect(newest.get(2)).toBeCloseTo(48.1375, 3);
  expect(client.newest.diagnostics).toMatchObject({ topic: '/diagnostics', counts: { warn: 1, ok: 3 } });
  expect(client.readings.get('/diagnostics')?.timeMs).toBeGreaterThan(0);
}, 30_000);
