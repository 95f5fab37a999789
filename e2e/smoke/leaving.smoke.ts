import { OperatorPage } from '../src/operator-page.ts';
import { robotLike } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';

/** The robot keeps a silent operator for a minute. Whatever ends sooner was told to end. */
const TOLD_MS = 30_000;

test('an operator whose tab closes, or goes elsewhere, makes room at once', async ({
  context,
  shared,
  startRobot,
}) => {
  const { id } = await startRobot(robotLike('left'));
  const expectOperators = (count: number) =>
    expect.poll(() => shared.metric(id, 'operators'), { message: 'operators', timeout: TOLD_MS }).toBe(count);
  const open = async () => {
    const page = await context.newPage();
    const operator = await OperatorPage.open(page, shared.stack.webUrl, { robot: id, canvas: '64x36' });
    await operator.expectState('session', 'live');
    await expectOperators(1);
    return page;
  };
  const closed = await open();
  await closed.close({ runBeforeUnload: true });
  await expectOperators(0);
  const gone = await open();
  await gone.goto('about:blank');
  await expectOperators(0);
});
