/** Who drives begins and ends recordings, and marks instants in them, from the page. */
import { mkdirSync, readdirSync, readFileSync } from 'node:fs';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { expectNothingCovered } from '../src/nothing-covered.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

/** At both ends of an MCAP file that is complete. */
const MAGIC = '\u0089MCAP0\r\n';

test('who drives begins a recording, marks an instant, and ends it', async ({
  page,
  startStack,
}, testInfo) => {
  const folder = testInfo.outputPath('recordings');
  mkdirSync(folder);
  const robot = { ...lightRobot, args: [...lightRobot.args, '--record-folder', folder] };
  await page.setViewportSize({ width: 1280, height: 720 });
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id, canvas: '64x36' });
  await operator.expectPoints(300);
  const [notice, about, panel] = ['#notice', '#about', '#commands'].map((each) => page.locator(each)) as [
    ReturnType<typeof page.locator>,
    ReturnType<typeof page.locator>,
    ReturnType<typeof page.locator>,
  ];
  if ((await panel.getAttribute('open')) === null) await panel.locator('summary').click();
  const command = (id: string) => panel.locator(`[data-command="${id}"]`);
  await expect(panel.getByRole('group', { name: 'Recording' }).getByRole('button')).toHaveText([
    'Recordonly who drives may',
    'Stop recordingonly who drives may',
    'Bookmarkonly who drives may',
  ]);
  await page.evaluate(() => window.farpoint.requestLease());
  await expect(command('bookmark')).toHaveAttribute('aria-disabled', 'false');
  await command('bookmark').click();
  await expect(notice).toHaveText('Bookmark failed: nothing is being recorded');
  await expect(about).toBeHidden();

  await command('record').click();
  await expect(notice).toHaveText(/^Record: .+-\d{8}T\d{6}Z\.mcap$/);
  await expect(about).toHaveText('This session is being recorded');
  await command('bookmark').click();
  await expect(notice).toHaveText('Bookmark: number 1');
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(3);
    await operator.look(testInfo, `recording-${size.width}`);
    await expectOnScreenAndApart(page.locator('#bar, #commands, #about, #drive button, #joystick'), size);
    await expectNothingCovered(page);
  }
  await page.setViewportSize({ width: 1280, height: 720 });
  if ((await panel.getAttribute('open')) === null) await panel.locator('summary').click();
  await command('record-stop').click();
  await expect(notice).toHaveText(/^Stop recording: .+\.mcap is complete$/);
  await expect(about).toBeHidden();
  const [name, ...others] = readdirSync(folder);
  expect(others).toEqual([]);
  const bytes = readFileSync(`${folder}/${name}`).toString('latin1');
  expect([bytes.startsWith(MAGIC), bytes.endsWith(MAGIC)]).toEqual([true, true]);
  expect(bytes).toContain('1, by ');
});
