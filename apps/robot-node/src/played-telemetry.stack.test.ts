/** The robot program records what it tells about itself, and plays it: marked, and at the times of the clouds. */
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import { ALARM_TYPES, openRecording, SAMPLE_TYPES } from '@farpoint/recording';
import { DIAGNOSTIC_TYPES } from '@farpoint/ros';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { SignaledOperator } from './testing/signaled-operator.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-played-telemetry-'));
const path = join(folder, 'drive.mcap');
afterAll(() => rmSync(folder, { recursive: true, force: true }));

async function withRobot(id: string, args: string[], use: (operator: SignaledOperator) => Promise<void>) {
  const stack = await LocalStack.start({
    robots: [{ id, name: 'Robot', args: [...args, '--max-points', '300', '--rate-control', 'fixed'] }],
  });
  try {
    const operator = await SignaledOperator.connect(stack.signalingUrl, id);
    await use(operator);
    await operator.close();
  } finally {
    await stack.stop();
  }
}

describe('telemetry of a recording', { timeout: 60_000 }, () => {
  /** Recorded values of the left motor. */
  const left = new Set<number>();

  beforeAll(async () => {
    const args = [
      '--sim-size',
      '64',
      '--sim-charge',
      '15',
      '--sim-origin',
      '48.1374,11.5755',
      '--record',
      path,
    ];
    await withRobot('recorded-1', args, async ({ client }) => {
      await client.until(() => client.newest.diagnostics !== undefined && client.samples.length >= 100);
      await client.until(() => client.completeFrames.length >= 20);
    });
    const recording = await openRecording(path);
    const of = (types: readonly string[]) =>
      recording.topics.filter(({ type, messages }) => types.includes(type) && (messages ?? 0) > 0);
    expect(of(SAMPLE_TYPES).map(({ name }) => name)).toEqual([
      ...['/farpoint/quantities/motors_left', '/farpoint/quantities/motors_right'],
      ...['latitude', 'longitude', 'altitude'].map((field) => `/farpoint/quantities/fix_${field}`),
    ]);
    expect(of(ALARM_TYPES).map(({ name }) => name)).toEqual(['/farpoint/alarms/charge']);
    expect(of(DIAGNOSTIC_TYPES).map(({ name }) => name)).toEqual(['/diagnostics']);
    for await (const { topic, data } of recording.messages(['/farpoint/quantities/motors_left'], 0n))
      left.add((topic.decode(data) as { value: number }).value);
    await recording.close();
    expect(left.size).toBeGreaterThan(5);
  }, 60_000);

  it('is told to operators, marked as recorded', async () => {
    await withRobot('played-1', ['--source', 'recording', '--path', path], async ({ client }) => {
      expect(await client.message('alarm')).toMatchObject({
        level: 'warn',
        limit: 20,
        unit: '%',
        recorded: true,
      });
      await client.until(() => client.newest.diagnostics !== undefined && client.samples.length >= 30);
      const quantities = client.session.filter((message) => message.type === 'quantity');
      expect(quantities.map(({ topic, field, recorded }) => `${topic} ${field} ${recorded}`)).toEqual([
        ...['/motors left true', '/motors right true'],
        ...['/fix latitude true', '/fix longitude true', '/fix altitude true'],
      ]);
      expect(client.newest.diagnostics).toMatchObject({
        ...{ topic: '/diagnostics', counts: { warn: 1, ok: 3 }, recorded: true },
      });
      const values = client.samples.filter(([number]) => number === 0).map(([, , value]) => value);
      expect(values.length).toBeGreaterThan(5);
      for (const value of values) expect(left).toContain(value);
    });
  });

  it('is left out with --play-telemetry none', async () => {
    const args = ['--source', 'recording', '--path', path, '--play-telemetry', 'none'];
    await withRobot('played-2', args, async ({ client }) => {
      await client.until(() => client.completeFrames.length >= 20);
      const told = client.session.filter(({ type }) => type === 'quantity' || type === 'alarm');
      expect([told, client.samples, client.newest.diagnostics]).toEqual([[], [], undefined]);
    });
  });
});
