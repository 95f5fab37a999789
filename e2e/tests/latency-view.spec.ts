/** Where the time goes between the robot's camera and the operator's eyes and hands: stages, tests, their history. */
import { readFileSync } from 'node:fs';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, LONG, simulatedRobot, test } from '../src/stack-test.ts';

const FIGURE = /^-?\d+(\.\d)? ms$/;
const figure = (text: string | null) => Number(/([\d.]+) ms$/.exec(text ?? '')?.[1] ?? 0);

test(
  'the stages of the clouds add up to their latency, tests are split and exported, and a lost link has no figures',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    const stack = await startStack();
    const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id, canvas: '64x36' });
    await operator.expectPoints();
    await page.keyboard.press('KeyB');
    const tile = page.locator('#dashboard').getByRole('region', { name: 'Latency', exact: true });
    await tile.scrollIntoViewIfNeeded();
    // The first clouds are dated by a clock of the robot that is hardly known yet: wait until the means are of later ones.
    await expect
      .poll(async () => (await operator.stats()).frameStages?.framesSeen, { message: 'clouds seen' })
      .toBeGreaterThan(100);
    const stages = tile.locator('.stages').first().locator('output');
    await expect(stages.nth(2)).toHaveText(FIGURE);
    await expect(stages.last()).toHaveText(FIGURE);
    const { shown, total } = await tile.evaluate((element) => {
      const outputs = element.querySelectorAll('.stages')[0]?.querySelectorAll('output') ?? [];
      return {
        shown: [...outputs].map(({ textContent }) => textContent),
        total: Number(/(\d+) ms/.exec(element.querySelector('.total')?.textContent ?? '')?.[1]),
      };
    });
    const { frameStages, frameLatencyMs } = await operator.stats();
    if (frameStages === null || frameLatencyMs === null) throw new Error('no stages');
    const { firstPacketMs, furtherPacketsMs, drawMs, totalMs } = frameStages;
    expect(firstPacketMs + furtherPacketsMs + drawMs).toBeCloseTo(totalMs, 6);
    for (const stage of [firstPacketMs, furtherPacketsMs, drawMs]) expect(stage).toBeGreaterThanOrEqual(0);
    expect(totalMs).toBeLessThanOrEqual(frameLatencyMs.max);
    // Written at once; each is rounded by itself.
    const sum = shown.reduce((sum, text) => sum + figure(text), 0);
    expect(Math.abs(sum - total)).toBeLessThan(4);

    // Once by the key, then one after another.
    await page.keyboard.press('KeyL');
    await expect(tile.locator('.last')).toHaveText(/^Last test, motion to photon: \d+ ms/);
    await tile.getByRole('button', { name: 'Continuous' }).click();
    await expect(tile.locator('.tests')).toHaveText(/^[3-9] tests: median \d+ ms/);
    await tile.getByRole('button', { name: 'Abort' }).click();
    await expect(tile.getByRole('button', { name: 'Continuous' })).toHaveAttribute('aria-pressed', 'false');
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      tile.getByRole('button', { name: 'CSV' }).click(),
    ]);
    const [head, ...rows] = readFileSync(await download.path(), 'utf8')
      .trimEnd()
      .split('\r\n');
    expect(head).toMatch(/^time,test,mtp_ms,/);
    const split = rows.map((row) => row.split(',').map(Number)).filter((row) => row[5]);
    expect(split.length).toBeGreaterThan(0);
    for (const row of split) {
      const [, , mtp, , , command, wait, cloud, draw] = row as [
        0,
        0,
        number,
        0,
        0,
        number,
        number,
        number,
        number,
      ];
      expect(command + wait + cloud + draw).toBeCloseTo(mtp, 1);
    }
    await operator.screenshots(page, testInfo, 'latency');

    // The history: loss and rate are curves that can be chosen.
    await page.getByRole('button', { name: 'Arrange' }).click();
    const curves = [
      ['Loss, %', /^\d+(\.\d+)? %$/],
      ['Rate, Mbit/s', /^\d+(\.\d+)? Mbit\/s$/],
      ['Cloud latency, ms', /^\d+(\.\d+)? ms$/],
    ] as const;
    for (const [title] of curves) await page.getByRole('button', { name: `+ ${title}`, exact: true }).click();
    await page.getByRole('button', { name: 'Arrange' }).click();
    for (const [title, value] of curves) {
      const curve = page.locator('#dashboard').getByRole('region', { name: title, exact: true });
      await curve.scrollIntoViewIfNeeded();
      await expect(curve.locator('.now')).toHaveText(value);
    }
    await operator.look(testInfo, 'history');

    await tile.scrollIntoViewIfNeeded();
    stack.robot(simulatedRobot.id).signal('SIGSTOP');
    await expect(stages).toHaveText(Array(6).fill('–'), { timeout: 3000 });
    await expect(tile.locator('.total')).toHaveText('Cloud, capture to display: –');
    await expect(tile.locator('.network')).toContainText('one way: –');
  },
);
