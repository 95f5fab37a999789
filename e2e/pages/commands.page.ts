/** The robot's commands as buttons, its recording, and bookmarks. */
import type { Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';

const button = (page: Page, name: string) => page.locator('#commands').getByRole('button', { name });

test('a command is given by a press, or by two, runs, and is cancelled; what it cannot is said', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'commands' });
  await stage.resize(1280, 720);
  await page.locator('#commands summary').click();
  await stage.run(500);
  await expect(button(page, 'Horn')).toHaveText('Hornnot while the emergency stop is on');
  await button(page, 'Lights').click();
  await button(page, 'Dock').click();
  await stage.run(500);
  await expect(button(page, 'Press again: Dock')).toBeVisible();
  await button(page, 'Press again: Dock').click();
  await button(page, 'Cancel: Self-test').click();
  await stage.run(200);
  const sent = await stage.script((control) => [
    ...control.sent('callCommand').map(({ id }) => id),
    ...control.sent('cancelCommand').map(({ run }) => run),
  ]);
  expect(sent).toEqual(['lights', 'dock', 1]);
  await stage.script(({ robot }) =>
    robot.tell({
      type: 'commandRun',
      run: 2,
      id: 'dock',
      by: { number: 1, name: 'Anna' },
      request: 2,
      state: 'failed',
      detail: 'no charger',
    }),
  );
  await stage.run(200);
  await expect(page.locator('#notice')).toHaveText('Dock: failed (no charger).');
});

test('a recording is begun and ended, and marked with a note; what is typed drives nothing', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'commands' });
  await stage.resize(1280, 720);
  await page.locator('#commands summary').click();
  await stage.script(({ robot }) => robot.giveLease('you'));
  await stage.run(500);
  await expect(page.locator('#commands .line')).toHaveText('Recording 1:02, 48 MB');
  await page.keyboard.press('KeyK');
  const note = page.getByPlaceholder('Note for the bookmark (optional)');
  await stage.run(100);
  await stage.script(({ robot }) =>
    robot.tell({
      type: 'commandRun',
      run: 3,
      id: 'bookmark',
      by: { number: 1, name: 'Anna' },
      request: 1,
      state: 'done',
    }),
  );
  await stage.run(100);
  await note.click();
  await page.keyboard.type('wax and kick');
  await page.keyboard.press('Enter');
  await button(page, 'Stop recording').click();
  await stage.run(200);
  const calls = await stage.script((control) =>
    control.sent('callCommand').map(({ id, text }) => [id, text ?? null]),
  );
  expect(calls).toEqual([
    ['bookmark', null],
    ['bookmark', 'wax and kick'],
    ['record-stop', null],
  ]);
  expect(await stage.script((control) => control.sent('estop').length)).toBe(0);
  await stage.script(({ robot }) =>
    robot.tell({ type: 'recording', on: false, bytes: 50_000_000, forS: 70 }),
  );
  await stage.run(500);
  await expect(page.locator('#commands .line')).toHaveText('Not recording');
  await expect(button(page, 'Record')).toBeVisible();
  await expect(note).toBeHidden();
});
