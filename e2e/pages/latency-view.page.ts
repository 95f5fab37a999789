/** Latency tests in the dashboard's tile with where the time goes. */
import { readFileSync } from 'node:fs';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

const STORED = { 'farpoint.settings': { synchronised: false } };

/** The robot answers each latency test with a green cloud. */
async function answerTests(stage: Stage): Promise<void> {
  await stage.script((stage) => {
    let answered = 0;
    setInterval(() => {
      const id = stage.sent('command').at(-1)?.latencyTest;
      if (id === undefined || id <= answered) return;
      answered = id;
      stage.tell({
        ...{ type: 'latencyFrame', id, frameNumber: 0, points: 9 },
        ...{ commandMs: stage.robot.nowMs, captureMs: stage.robot.nowMs },
      });
      stage.cloud('light', { latencyTest: true });
    }, 20);
  });
}

async function openTile(stage: Stage) {
  const { page } = stage;
  await page.keyboard.press('KeyB');
  const dashboard = page.locator('#dashboard');
  await dashboard.getByRole('region', { name: 'Speed', exact: true }).waitFor();
  await page.getByRole('button', { name: 'Arrange' }).click();
  await page.getByRole('button', { name: '+ Where the time goes' }).click();
  await page.getByRole('button', { name: 'Arrange' }).click();
  const tile = dashboard.getByRole('region', { name: 'Where the time goes', exact: true });
  await tile.getByRole('button', { name: 'Single' }).scrollIntoViewIfNeeded();
  const press = (name: string) => tile.getByRole('button', { name, exact: true }).click();
  return { tile, press, button: (name: string) => tile.getByRole('button', { name, exact: true }) };
}

test('a test is run once, or again and again until Abort, and its results are a table', async ({ stage }) => {
  const page = await stage.open({ state: 'live', stored: STORED });
  await answerTests(stage);
  const { tile, press, button } = await openTile(stage);
  await expect(tile.locator('.last')).toHaveText('Motion to photon: not measured yet');
  await expect(button('Abort')).toBeDisabled();
  await expect(button('Tests as CSV')).toBeDisabled();

  await press('Single');
  await stage.run(500);
  await expect(tile.locator('.last')).toHaveText(/^Motion to photon: \d+ ms, first points \d+ ms$/);
  await expect(tile.locator('.tests')).toHaveText(/^Last 1 test: median \d+ ms, 95 of 100 within \d+ ms$/);

  await press('Continuous');
  await expect(button('Single')).toBeDisabled();
  await stage.run(3000);
  await press('Abort');
  await stage.run(1000);
  const told = await tile.locator('.tests').textContent();
  // At most two a second, the pause after each counted.
  const [, count] = /^Last (\d+) tests: median/.exec(told ?? '') ?? [];
  expect(Number(count)).toBeGreaterThanOrEqual(4);
  expect(Number(count)).toBeLessThanOrEqual(8);
  await stage.run(2000);
  await expect(tile.locator('.tests')).toHaveText(told ?? '');

  // A closed dashboard ends a run: only it says why the cloud is green.
  await press('Continuous');
  await page.keyboard.press('KeyB');
  await stage.run(2000);
  await page.keyboard.press('KeyB');
  await stage.run(500);
  await expect(button('Abort')).toBeDisabled();

  const download = page.waitForEvent('download');
  await press('Tests as CSV');
  const lines = readFileSync(await (await download).path(), 'utf8')
    .trim()
    .split('\r\n');
  expect(lines[0]).toBe('time,test,mtp_ms,first_ms,arrived_ms,points,total_points,failure');
  // The run that was closed has had a test, or two.
  expect(lines.length).toBeGreaterThan(1 + Number(count) + 2);
  expect(lines.length).toBeLessThanOrEqual(1 + Number(count) + 2 + 2);
});

test('a test without an answer says so', async ({ stage }) => {
  await stage.open({ state: 'live', stored: STORED });
  const { tile, press } = await openTile(stage);
  await press('Single');
  await stage.run(4000);
  await expect(tile.locator('.last')).toHaveText('Motion to photon: no green cloud arrived');
  await expect(tile.locator('.tests')).toHaveText('Last 1 test, 1 failed');
});
