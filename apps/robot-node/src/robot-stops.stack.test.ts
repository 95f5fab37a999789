/** A stop at the robot itself, in shared memory, at the real robot program. */
import { rmSync } from 'node:fs';
import { join } from 'node:path';
import { eventually } from '@farpoint/service/testing/eventually';
import { isAvailable, StopBlockWriter } from '@farpoint/shared-memory';
import { describe, expect, it } from 'vitest';
import {
  CLEAR,
  driving,
  HELD,
  ID,
  untilReading,
  untilState,
  useStoppedRobot,
} from './testing/use-stopped-robot.ts';

const robot = useStoppedRobot();

describe('a stop byte in shared memory', { skip: !isAvailable(), timeout: 40_000 }, () => {
  it('stops a driving robot, whoever asks for release; a counter that stands still does, too', async () => {
    let pressed = false;
    let beats = true;
    const writer = new StopBlockWriter(join(robot.folder, 'stop'));
    const beating = setInterval(() => beats && writer.write(pressed), 20);
    robot.ending.push(
      () => clearInterval(beating),
      () => writer.close(),
    );
    const { stack, driver } = await robot.start(['--stop-shm', 'stop', '--shm-folder', robot.folder]);
    const { client } = driver;
    await untilState(client, CLEAR);
    const lease = await client.takeLease();
    let end = await driving(client, lease);
    pressed = true;
    await untilState(client, { ...HELD, by: 'robot' });
    await client.until(() => client.telemetry?.twist.linear.x === 0);
    client.releaseEstop();
    expect(await client.message('fault')).toMatchObject({ message: expect.stringContaining('at the robot') });
    await untilState(client, HELD);
    await untilReading(client, 'shm', 'warn');
    // The hand that holds on moves nothing after the release.
    pressed = false;
    await untilState(client, CLEAR);
    const { sequence } = client.telemetry ?? { sequence: 0 };
    await client.until(() => (client.telemetry?.sequence ?? 0) > sequence + 4);
    expect(client.telemetry?.twist.linear.x).toBe(0);
    end();
    end = await driving(client, lease);
    beats = false;
    await untilState(client, HELD);
    end();
    await untilReading(client, 'shm', 'error');
    const health = async () => (await fetch(`${stack.robotAdminUrl(ID)}/healthz`)).json();
    await eventually(async () => JSON.stringify(await health()).includes('"shm":"silent"'));
    const metrics = await (await fetch(`${stack.robotAdminUrl(ID)}/metrics`)).text();
    // More of them where a busy machine kept the counter waiting.
    const [, stops] = /robot_stops[^\n]*stop="shm"[^\n]* (\d+)\n/.exec(metrics) ?? [];
    expect(Number(stops)).toBeGreaterThanOrEqual(2);
    beats = true;
    await untilState(client, CLEAR);
    // A program that has ended, and one that makes the file anew.
    rmSync(join(robot.folder, 'stop'));
    await untilState(client, HELD);
    beats = false;
    const next = new StopBlockWriter(join(robot.folder, 'stop'));
    const others = setInterval(() => next.write(false), 20);
    robot.ending.push(
      () => clearInterval(others),
      () => next.close(),
    );
    await untilState(client, CLEAR);
  });
});
