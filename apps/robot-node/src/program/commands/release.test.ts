import { readdirSync } from 'node:fs';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, describe, expect, it } from 'vitest';
import { EstopJournal } from '../../motion/drive/estop-journal.ts';
import { release } from './release.ts';

const ID = 'robot-1';

let folder: string;
beforeEach(() => {
  folder = testFolder();
});

const start = () => new EstopJournal(folder, ID, () => undefined);

/** A robot that was killed and runs again. */
function restarted(): EstopJournal {
  start();
  return start();
}

/** @param robot what the robot does meanwhile */
async function run(robot: () => void = () => undefined, ...argv: string[]) {
  let out = '';
  let errors = '';
  const options = ['--id', ID, '--state-dir', folder, '--source', 'sim', ...argv];
  const code = await release(options, {
    stdout: { write: (text) => (out += text) },
    stderr: { write: (text) => (errors += text) },
    env: {},
    wait: async () => robot(),
  });
  return { code, out, errors };
}

describe('farpoint-robot release', () => {
  it('says when the robot has released its emergency stop', async () => {
    const robot = restarted();
    const { code, out } = await run(() => {
      if (robot.request.take()) robot.changed(null);
    });
    expect([code, out]).toEqual([0, expect.stringContaining('Released')]);
  });

  it('says what holds it, and that the log knows why a robot refused', async () => {
    const robot = restarted();
    const refuses = () => void robot.request.take();
    expect(await run(refuses)).toMatchObject({ code: 1, errors: expect.stringContaining('log') });
    robot.changed('robot', ['gpio']);
    expect(await run(refuses)).toMatchObject({
      code: 1,
      errors: expect.stringContaining('released there: gpio'),
    });
  });

  it('leaves nothing behind for a robot that does not answer', async () => {
    restarted();
    expect(await run()).toMatchObject({ code: 1, errors: expect.stringContaining('does not answer') });
    expect(readdirSync(folder)).toEqual([`${ID}.run.json`]);
  });

  it('asks nothing of a robot that does not run, or is not latched', async () => {
    expect(await run()).toMatchObject({ code: 1, errors: expect.stringContaining('runs') });
    const robot = start();
    expect(await run()).toMatchObject({ code: 0, out: expect.stringContaining('not latched') });
    robot.changed('operator');
    robot.end();
    expect(await run()).toMatchObject({ code: 1 });
    expect(readdirSync(folder)).toEqual([`${ID}.run.json`]);
  });

  it('names a mistake in the options', async () => {
    expect(await run(undefined, '--fps', 'many')).toMatchObject({
      code: 2,
      errors: expect.stringContaining('fps'),
    });
    expect(await run(undefined, '--help')).toMatchObject({
      code: 0,
      out: expect.stringContaining('release'),
    });
  });
});
