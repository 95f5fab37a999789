import { expect, test } from '../src/stack-test.ts';

test.use({ viewport: { width: 360, height: 740 }, hasTouch: true });

test('on a phone held upright every control is on the screen and none covers another', async ({
  page,
  openRobot,
}, testInfo) => {
  const { operator } = await openRobot();
  await operator.screenshot(testInfo, 'phone');
  const controls = page.locator(
    '#bar button:visible, #bar select:visible, #bar #link, #drive button:visible, #joystick',
  );
  await expect(page.getByRole('button', { name: 'Disconnect' })).toBeVisible();
  await expect(page.getByRole('button', { name: 'Settings' })).toBeVisible();
  // The words about the link are not cut.
  expect(await page.locator('#link').evaluate((link) => link.scrollWidth - link.clientWidth)).toBe(0);
  const boxes = await controls.evaluateAll((elements) =>
    elements.map((element) => {
      const { left, top, right, bottom } = element.getBoundingClientRect();
      return { name: element.id, left, top, right, bottom };
    }),
  );
  expect(boxes.length).toBeGreaterThan(5);
  for (const [i, box] of boxes.entries()) {
    expect(box.right, box.name).toBeLessThanOrEqual(360);
    expect(box.left, box.name).toBeGreaterThanOrEqual(0);
    expect(box.bottom, box.name).toBeLessThanOrEqual(740);
    expect(box.right - box.left, box.name).toBeGreaterThan(24);
    for (const other of boxes.slice(i + 1)) {
      const apart =
        box.right <= other.left ||
        other.right <= box.left ||
        box.bottom <= other.top ||
        other.bottom <= box.top;
      expect(apart, `${box.name} and ${other.name}`).toBe(true);
    }
  }
  await page.getByRole('button', { name: 'Disconnect' }).tap();
  await expect(page.getByRole('button', { name: /Simulated robot 1/ })).toBeVisible();
});
