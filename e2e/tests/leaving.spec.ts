import type { LocalStack } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

/** This robot keeps a silent operator for a minute. Whatever ends sooner was told to end. */
const robotForOne = { ...simulatedRobot, args: [...simulatedRobot.args, '--max-operators', '1'] };
const options = { robot: simulatedRobot.id, canvas: '64x36' };

async function expectOperators(stack: LocalStack, count: number): Promise<void> {
  const operators = async () => {
    const text = await (await fetch(`${stack.robotAdminUrl(simulatedRobot.id)}/metrics`)).text();
    return Number(/^farpoint_robot_operators (\d+)$/m.exec(text)?.[1]);
  };
  const began = performance.now();
  await expect.poll(operators, { message: 'operators', intervals: [10], timeout: 20_000 }).toBe(count);
  console.log(`  ${count} operators after ${Math.round(performance.now() - began)} ms`);
}

const ways: [how: string, leave: (page: Page) => Promise<unknown>][] = [
  ['its tab is closed', (page) => page.close({ runBeforeUnload: true })],
  ['it goes to another page', (page) => page.goto('about:blank')],
  ['it is left by a link to elsewhere', (page) => page.goto('data:text/html,elsewhere')],
];

test('an operator whose page closes makes room immediately', async ({ context, startStack }) => {
  const stack = await startStack({ robots: [robotForOne] });
  for (const [how, leave] of ways) {
    const page = await context.newPage();
    const operator = await OperatorPage.open(page, stack, options);
    await operator.expectState('session', 'live');
    await expectOperators(stack, 1);
    console.log(`  ${how}`);
    await leave(page);
    await expectOperators(stack, 0);
    if (!page.isClosed()) await page.close();
  }
});

test('a page that the browser caches leaves the robot, and reconnects when it is restored', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: [robotForOne] });
  const operator = await OperatorPage.open(page, stack, options);
  await operator.expectPoints();
  const transition = (type: string) =>
    page.evaluate((type) => window.dispatchEvent(new PageTransitionEvent(type, { persisted: true })), type);
  for (let sessions = 2; sessions <= 3; sessions++) {
    await transition('pagehide');
    await expectOperators(stack, 0);
    expect(await operator.state()).toMatchObject({ session: 'none', signaling: 'stopped' });
    await transition('pageshow');
    await operator.expectPoints();
    expect((await operator.state()).sessionsOpened).toBe(sessions);
  }
});
