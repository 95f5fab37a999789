/** Two people at one robot: the drive goes from hand to hand as agreed, and they read each other's lines. */
import type { Page } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { HeadsetReader } from '../src/headset-reader.ts';
import { expectNothingCovered } from '../src/nothing-covered.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const handover = (page: Page) => page.getByRole('region', { name: 'Handing over the drive' });
const screens = [
  { width: 360, height: 740 },
  { width: 1280, height: 720 },
  { width: 3840, height: 2160 },
];

test('an offer is accepted and drives after a fresh grip only, a request is refused, and lines are text', async ({
  page,
  browser,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const enter = async (on: Page, name: string) => {
    const operator = await OperatorPage.open(on, stack, { robot: lightRobot.id, canvas: '64x36', name });
    await operator.expectPoints(100);
    return operator;
  };
  const bobsPage = await (await browser.newContext()).newPage();
  const [ada, bob] = [await enter(page, 'Ada'), await enter(bobsPage, 'Bob')];
  await page.bringToFront();
  await ada.holdForward();
  await ada.expectState('holder', 'you');
  await ada.releaseKeys();
  await ada.expectStanding();

  await page.getByText('2 are here: you drive').click();
  const offer = async () => {
    await page.getByRole('button', { name: 'Offer the drive to Bob' }).click();
    await expect(handover(page).getByRole('status')).toHaveText('You have offered “Bob” the drive');
    await expect(page.getByRole('button', { name: 'Offer the drive to Bob' })).toHaveCount(0);
    await expect(handover(bobsPage).getByRole('alert')).toHaveText('“Ada” offers you the drive');
  };
  // One offer for each screen: it lasts 15 s.
  for (const screen of screens) {
    await bobsPage.setViewportSize(screen);
    await offer();
    await expectNothingCovered(bobsPage);
    await bob.look(testInfo, `offered-${screen.width}`);
    await page.getByRole('button', { name: 'Take back' }).click();
    await expect(handover(bobsPage)).toBeHidden();
  }
  await bobsPage.setViewportSize({ width: 1280, height: 720 });

  // Bob's hand is on the keys before the drive is his.
  await bobsPage.bringToFront();
  await bob.holdForward();
  await offer();
  const from = await bob.body();
  await bobsPage.bringToFront();
  await bobsPage.getByRole('button', { name: 'Take the drive' }).click();
  await bob.expectState('holder', 'you');
  await ada.expectState('holder', 'other');
  await expect(handover(page)).toBeHidden();
  await expect(page.locator('#notice')).toHaveText('“Bob” drives now.');
  // The keys are held still, and move nothing until they were let go.
  await expect.poll(async () => (await bob.state()).gripLost).not.toBeNull();
  await bob.expectFrames(10);
  const { x, y } = await bob.body();
  expect(Math.hypot(x - from.x, y - from.y)).toBeLessThan(0.01);
  await bob.releaseKeys();
  await bob.expectState('gripLost', null);
  await bob.holdForward();
  await bob.expectMovedFrom(from, 0.05);
  await bob.releaseKeys();

  await page.getByRole('button', { name: 'Ask to drive' }).click();
  await expect(handover(bobsPage).getByRole('alert')).toHaveText('“Ada” asks to drive');
  await bobsPage.getByRole('button', { name: 'Refuse' }).press('Enter');
  await expect(page.locator('#notice')).toHaveText('“Bob” has refused: the drive has not changed hands.');
  await bob.expectState('holder', 'you');

  await page.locator('#chat > summary').click();
  const line = page.getByLabel('Line to all who are here');
  await line.fill('<b>Mind</b> the step');
  await line.press('Enter');
  const lines = (of: Page) => of.getByRole('log', { name: 'Chat' });
  await expect(lines(page)).toContainText('You <b>Mind</b> the step');
  await expect(line).toHaveValue('');
  await expect(bobsPage.locator('#chat > summary')).toHaveText(/^Chat\s+1 new$/);
  await bobsPage.locator('#chat > summary').click();
  await expect(lines(bobsPage)).toContainText('“Ada” <b>Mind</b> the step');
  await expect(lines(bobsPage).locator('b')).toHaveCount(1);
  await expect(bobsPage.locator('#chat > summary')).toHaveText(/^Chat\s*$/);
  for (const screen of screens) {
    await page.setViewportSize(screen);
    await expectNothingCovered(page);
    await ada.look(testInfo, `chat-${screen.width}`);
  }
  await bobsPage.context().close();
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('the drive is offered by the menu, taken back, offered again, and taken', async ({
    page,
    browser,
    startStack,
  }, testInfo) => {
    const stack = await startStack({ robots: [lightRobot] });
    const headset = await Headset.wear(page);
    const ada = await OperatorPage.open(page, stack, { robot: lightRobot.id, name: 'Ada' });
    await ada.expectPoints(300);
    const bobsPage = await (await browser.newContext()).newPage();
    await OperatorPage.open(bobsPage, stack, { robot: lightRobot.id, canvas: '64x36', name: 'Bob' });
    await page.bringToFront();
    await enterVr(page, ada);
    const reader = new HeadsetReader(page, headset);
    await ada.hold(headset.grip('right'));
    await ada.expectState('holder', 'you');
    await ada.release();
    const choose = async (...rows: RegExp[]) => {
      await headset.press('right', 'a-button');
      for (const row of rows) {
        await reader.chooseByRay('right', row);
        await ada.look(testInfo, `after-${row.source.replace(/\W+/g, '-')}`);
      }
      expect(await reader.menu()).toBeNull();
    };
    await expect(bobsPage.getByText(/^2 are here/)).toBeVisible();
    await choose(/^Offer the drive…/, /^“Bob” \(may drive\)$/);
    await expect(handover(bobsPage).getByRole('alert')).toHaveText('“Ada” offers you the drive');
    await choose(/^Take back the offer to “Bob”$/);
    await expect(handover(bobsPage)).toBeHidden();
    await choose(/^Offer the drive…/, /^“Bob”/);
    await bobsPage.getByRole('button', { name: 'Take the drive' }).dispatchEvent('click');
    await ada.expectState('holder', 'other');
    await expect.poll(() => reader.notice()).toBe('“Bob” drives now.');
    await bobsPage.context().close();
  });
});
