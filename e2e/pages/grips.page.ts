/** A hand that nobody reads, or that belongs to somebody who does not look, drives nothing. */
import { headsetViewport } from '../src/headset.ts';
import { enterVr } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { FRAME_MS, type Stage } from '../src/stage/stage.ts';

/** What the last command says. */
async function lastCommand(stage: Stage) {
  const command = (await stage.sent('command')).at(-1);
  if (command === undefined) throw new Error('nothing was commanded');
  return { deadMan: command.deadMan, unread: command.unread ?? false, speed: command.twist.linear.x };
}
const DRIVES = { deadMan: true, unread: false, speed: 0.5 };

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('frames that stop with the grip held: after 100 ms the robot brakes, after 300 ms the grip must be opened', async ({
    stage,
  }) => {
    const headset = await enterVr(stage, { frameMs: FRAME_MS });
    await headset.thumbstick('right', 0, -1);
    await headset.button('right', 'squeeze', 1);
    await stage.run(400);
    expect(await lastCommand(stage)).toEqual(DRIVES);
    expect((await stage.state()).driving).toBe(true);

    await stage.freeze();
    await stage.run(84);
    expect(await lastCommand(stage)).toEqual(DRIVES);
    await stage.run(40);
    expect(await lastCommand(stage)).toMatchObject({ unread: true });
    expect(await stage.state()).toMatchObject({ driving: false, gripLost: null });
    await stage.run(200);
    expect(await stage.state()).toMatchObject({ driving: false, gripLost: 'late-reading' });

    // The frames come back, the hand still holds on: nothing drives.
    await stage.forget();
    await stage.thaw();
    await stage.run(500);
    expect(await stage.state()).toMatchObject({ driving: false, gripLost: 'late-reading' });
    expect((await stage.sent('command')).filter(({ deadMan }) => deadMan)).toEqual([]);
    await headset.button('right', 'squeeze', 0);
    await stage.frames(5);
    await headset.button('right', 'squeeze', 1);
    await stage.run(200);
    expect(await lastCommand(stage)).toEqual(DRIVES);
  });

  test('taken off with the grip held: the robot stops at once, after two seconds it is free for others, and it waits for a fresh grip', async ({
    stage,
  }) => {
    const headset = await enterVr(stage, { frameMs: FRAME_MS });
    await headset.thumbstick('right', 0, -1);
    await headset.button('right', 'squeeze', 1);
    await stage.run(400);
    expect(await stage.state()).toMatchObject({ driving: true, holder: 'you' });

    await headset.worn(false);
    await stage.run(50);
    expect((await stage.state()).driving).toBe(false);
    expect(await lastCommand(stage)).toMatchObject({ speed: 0 });
    await stage.run(1900);
    expect((await stage.state()).holder).toBe('you');
    await stage.run(100);
    expect((await stage.state()).holder).toBe('nobody');
    expect(await stage.sent('leaseRelease')).toHaveLength(1);

    await headset.worn(true);
    await stage.run(500);
    expect((await stage.state()).driving).toBe(false);
    await headset.button('right', 'squeeze', 0);
    await stage.frames(5);
    await headset.button('right', 'squeeze', 1);
    await stage.run(200);
    expect(await stage.state()).toMatchObject({ driving: true, holder: 'you' });
  });
});

test('a command says what is on the screen, not what has arrived', async ({ stage }) => {
  const { keyboard } = await stage.open({ frameMs: FRAME_MS });
  await keyboard.down('Space');
  await stage.run(200);
  await keyboard.down('KeyW');
  await stage.run(400);
  const seen = async () => (await stage.sent('command')).at(-1)?.seenUs ?? 0;
  const first = await seen();
  await stage.run(200);
  expect((await seen()) - first).toBe(200_000);

  await stage.freeze();
  await stage.run(100);
  const frozen = await seen();
  await stage.run(400);
  // Clouds go on arriving.
  expect((await stage.stats()).framesPerSecond).toBeGreaterThan(0);
  expect(await seen()).toBe(frozen);
  await stage.thaw();
  await stage.run(200);
  expect((await seen()) - frozen).toBeGreaterThan(400_000);
});
