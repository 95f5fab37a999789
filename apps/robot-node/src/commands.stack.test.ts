/** Commands and recordings at the running robot: who may, what all are told, and what is in the file and in the audit log. */
import { mkdirSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { CommandRefusal, CommandState, Role } from '@farpoint/protocol';
import { openRecording } from '@farpoint/recording';
import { describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import type { SignaledOperator } from './testing/signaled-operator.ts';
import { useGrantingRobot } from './testing/use-granting-robot.ts';

const ID = 'sim-1';
let auditLog = '';
let recordings = '';
const robot = await useGrantingRobot(ID, (folder) => {
  [auditLog, recordings] = [join(folder, 'audit.jsonl'), join(folder, 'recordings')];
  mkdirSync(recordings);
  return ['--sim-commands', '--record-folder', recordings, '--audit-log', auditLog];
});

type Client = SignaledOperator['client'];
const enter = async (name: string, role: Role): Promise<Client> =>
  (await robot.connect(await robot.grant(name, role))).client;
let request = 0;

function call(client: Client, id: string, text?: string) {
  const own = ++request;
  const more = text === undefined ? {} : { text };
  client.sendSession({ type: 'callCommand', id, request: own, timeMs: performance.now(), ...more });
  return {
    is: (state: CommandState) =>
      client.message('commandRun', (each) => each.request === own && each.state === state),
    refused: async (): Promise<CommandRefusal> =>
      (await client.message('commandRefused', (each) => each.request === own)).reason,
  };
}

describe('a robot with commands and a folder for recordings', { timeout: 60_000 }, () => {
  it('lets a supervisor record, a driver mark what is recorded, and a guest neither; all see it', async () => {
    const [driver, guest] = [await enter('Ada', 'drive'), await enter('Wim', 'watch')];
    const supervisor = await enter('Sue', 'supervise');
    expect(await call(driver, 'record').refused()).toBe('not-permitted');
    expect(await call(guest, 'bookmark').refused()).toBe('not-permitted');
    const { detail: name = '' } = await call(supervisor, 'record').is('done');
    expect(await guest.message('about', ({ recorded }) => recorded)).toBeDefined();
    const told = await guest.message('recording', ({ on, forS, bytes }) => on && forS > 0 && bytes > 0);
    expect(told.bytes).toBeLessThan(1e9);
    expect(await guest.message('commandRun', (each) => each.id === 'record')).toMatchObject({
      by: { name: 'Sue' },
    });
    expect(await call(driver, 'bookmark', 'wheel slips – here').is('done')).toMatchObject({
      detail: 'wheel slips – here',
    });
    await call(driver, 'bookmark').is('done');
    expect(await call(driver, 'record-stop').refused()).toBe('not-permitted');
    await call(supervisor, 'record-stop').is('done');
    await guest.message('recording', ({ on }) => !on);
    expect(readdirSync(recordings)).toEqual([name]);
    const recording = await openRecording(join(recordings, name));
    const marks: unknown[] = [];
    for await (const { topic, data } of recording.messages(['/farpoint/bookmarks'], 0n))
      marks.push(topic.decode(data));
    await recording.close();
    expect(recording.warning).toBeNull();
    expect(marks).toMatchObject([
      { name: 'Ada', message: 'wheel slips – here' },
      { name: 'Ada', message: 'bookmark 1' },
    ]);
  });

  it('cancels a self-test by STOP, and writes everything down', async () => {
    const driver = await enter('Ada', 'drive');
    await driver.takeLease();
    const test = call(driver, 'self-test');
    await driver.message('commandRun', (each) => each.progress !== undefined);
    driver.sendSession({ type: 'estop', latch: true });
    expect(await test.is('cancelled')).toMatchObject({ detail: 'by STOP' });
    expect(await call(driver, 'self-test').refused()).toBe('estop');
    expect(await call(driver, 'dock').refused()).toBe('unknown');
    const metric = (name: string) => metricOf(robot.robot.stack.robotAdminUrl(ID), `farpoint_robot_${name}`);
    expect(await metric('command_calls_total{command="self-test"}')).toBe(1);
    expect(await metric('command_outcomes_total{outcome="cancelled"}')).toBe(1);
    expect(await metric('command_outcomes_total{outcome="unknown"}')).toBe(1);
    const entries = readFileSync(auditLog, 'utf8')
      .trim()
      .split('\n')
      .map(
        (line) =>
          JSON.parse(line) as { kind: string; subject?: { name: string }; details: Record<string, unknown> },
      )
      .filter(({ kind, details }) => kind.startsWith('command-') || details?.what === 'robot-command')
      .map(({ kind, subject, details }) => [
        kind,
        subject?.name,
        details.command ?? details.reason,
        details.text,
      ]);
    expect(entries).toContainEqual(['command-began', 'Sue', 'record', undefined]);
    expect(entries).toContainEqual(['command-began', 'Ada', 'bookmark', 'wheel slips – here']);
    expect(entries).toContainEqual(['command-ended', 'Ada', 'self-test', 'by STOP']);
    expect(entries).toContainEqual(['refused', 'Wim', 'not-permitted', undefined]);
  });
});
