/** Stops at the robot itself, at the real robot program: a stand-in for a GPIO chip, and the console. */
import { FAKE_CHIP, FakeChip } from '@farpoint/gpio/testing';
import { describe, it } from 'vitest';
import {
  CLEAR,
  driving,
  HELD,
  ID,
  untilOperatorsOwn,
  untilReading,
  untilState,
  useStoppedRobot,
} from './testing/use-stopped-robot.ts';

const robot = useStoppedRobot();

const chip = FakeChip.build();
describe('a GPIO line (stand-in for a chip)', { skip: chip === null, timeout: 40_000 }, () => {
  it('stops while it is active, and when it cannot be read', async () => {
    if (chip === null) return;
    robot.ending.push(() => chip.close());
    chip.set(17, true);
    const name = FAKE_CHIP.replace('/dev/', '');
    const { driver } = await robot.start(['--stop-gpio', `${name}:17:active-low`], {}, chip.env);
    const { client } = driver;
    await untilState(client, CLEAR);
    const lease = await client.takeLease();
    const end = await driving(client, lease);
    chip.set(17, false);
    await untilState(client, HELD);
    await client.until(() => client.telemetry?.twist.linear.x === 0);
    end();
    chip.set(17, true);
    await untilState(client, CLEAR);
    chip.unplug(17);
    await untilState(client, HELD);
    await untilReading(client, 'gpio', 'error');
    chip.set(17, true);
    await untilState(client, CLEAR);
    // An operator's own latch stays, and is released as ever.
    client.sendSession({ type: 'estop', latch: true, press: 1 });
    await untilState(client, { latched: true, by: 'operator' });
    chip.set(17, false);
    await untilState(client, { ...HELD, by: 'operator' });
    chip.set(17, true);
    await untilOperatorsOwn(client);
    client.releaseEstop();
    await untilState(client, CLEAR);
  });
});

describe('the console', { timeout: 40_000 }, () => {
  it('stops by any key, over a restart, until somebody types release; without a console the robot stands', async () => {
    const { stack, driver } = await robot.start(['--stop-key'], { input: true });
    const { client } = driver;
    await untilState(client, CLEAR);
    stack.robot(ID).type(' ');
    await untilState(client, HELD);
    await driver.close();
    await stack.robot(ID).kill();
    await stack.restartRobot(ID);
    const after = await robot.connect(stack);
    await untilState(after.client, HELD);
    await after.client.takeLease();
    after.client.releaseEstop();
    await after.client.message('fault');
    stack.robot(ID).type('release\n');
    // It was killed: what is left is the latch of an unclean exit, which whoever drives releases.
    await untilOperatorsOwn(after.client);
    after.client.releaseEstop();
    await untilState(after.client, CLEAR);
    stack.robot(ID).type(null);
    await untilReading(after.client, 'key', 'error');
    await untilState(after.client, HELD);
  });
});
