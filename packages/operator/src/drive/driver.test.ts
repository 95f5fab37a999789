import type { Command, OperatorSessionMessage } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import type { DriveInput } from './drive-input.ts';
import { Driver } from './driver.ts';
import type { GripLoss } from './grips.ts';
import { WishInput } from './wish-input.ts';

function bench() {
  const commands: Command[] = [];
  const messages: OperatorSessionMessage[] = [];
  let told = 0;
  const hand = new WishInput();
  const driver = new Driver([hand], {
    sendCommand: (command) => commands.push(command),
    sendSession: (message) => messages.push(message),
    onOtherDrives: () => told++,
  });
  driver.onLimits({ maxLinear: 1, maxAngular: 1, watchdogMs: 150, maxCommandsPerSecond: 100 });
  return { commands, messages, hand, driver, told: () => told };
}

/** One that drives ahead since 0 ms. */
function driving() {
  const made = bench();
  made.driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
  made.hand.held = true;
  made.hand.wish.forward = 1;
  made.driver.sendDue(0);
  return made;
}

describe('Driver', () => {
  test('pressing the grip requests the lease, after which commands are sent', () => {
    const { commands, messages, hand, driver } = bench();
    hand.held = true;
    hand.wish.forward = 1;
    for (const now of [0, 25, 50]) driver.sendDue(now);
    expect(messages).toEqual([{ type: 'leaseRequest', take: false }]);
    expect(commands).toEqual([]);
    driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
    driver.sendDue(75);
    expect(commands).toHaveLength(1);
    expect(commands[0]?.twist.linear.x).toBe(1);
  });

  test('a push without the grip is told once, while the page has the keys', () => {
    const missing: string[] = [];
    const hand = new WishInput();
    const driver = new Driver([hand], {
      sendCommand: () => undefined,
      sendSession: () => undefined,
      onOtherDrives: () => undefined,
      onGripMissing: (device) => missing.push(device),
    });
    hand.wish.forward = 1;
    driver.suspended = true;
    for (let now = 0; now <= 1000; now += 25) driver.sendDue(now);
    expect(missing).toEqual([]);
    expect(driver.isGripped).toBe(false);
    driver.suspended = false;
    for (let now = 1025; now <= 3000; now += 25) driver.sendDue(now);
    expect(missing).toEqual(['script']);
  });

  test('a drive that is handed over moves nothing until the grip was opened and pressed anew', () => {
    const { commands, hand, driver } = bench();
    hand.held = true;
    hand.wish.forward = 1;
    driver.onLease({ type: 'lease', holder: 'other' });
    for (let now = 0; now < 500; now += 25) driver.sendDue(now);
    driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
    driver.onHandedOver(500);
    expect(driver.lost).toBe('other-drives');
    for (let now = 525; now < 3000; now += 25) driver.sendDue(now);
    // It shows the robot an open grip, for a second: the robot may still be braking.
    expect(commands.length).toBeGreaterThan(30);
    expect(commands.length).toBeLessThan(50);
    expect(commands.some(({ deadMan, twist }) => deadMan || twist.linear.x !== 0)).toBe(false);
    hand.held = false;
    driver.sendDue(3000);
    hand.held = true;
    driver.sendDue(3025);
    expect(commands.at(-1)).toMatchObject({ deadMan: true, twist: { linear: { x: 1 } } });
  });

  test('an open hand to which the drive is handed shows the robot that it is open', () => {
    const { commands, hand, driver } = bench();
    driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
    driver.onHandedOver(0);
    driver.sendDue(25);
    expect(commands.map(({ deadMan }) => deadMan)).toEqual([false, false]);
    [hand.held, hand.wish.forward] = [true, 1];
    driver.sendDue(50);
    expect(commands.at(-1)?.twist.linear.x).toBe(1);
  });

  test('requests the lease again while there is no answer, but never takes it over', () => {
    const { messages, hand, driver, told } = bench();
    hand.held = true;
    for (let now = 0; now <= 1000; now += 25) driver.sendDue(now);
    expect(messages).toHaveLength(3);
    driver.onLease({ type: 'lease', holder: 'other' });
    for (let now = 1000; now <= 2000; now += 25) driver.sendDue(now);
    expect(messages).toHaveLength(3);
    expect(told()).toBe(1);
  });

  test('the grip counts as released while the page is hidden', () => {
    const { commands, driver } = driving();
    driver.suspended = true;
    for (let now = 25; now < 1000; now += 25) driver.sendDue(now);
    expect(commands.slice(1).every((command) => !command.deadMan && command.twist.linear.x === 0)).toBe(true);
    expect(commands.length).toBeLessThan(8);
  });

  test('letting go stops, releases the lease, and ignores a grip that stays held', () => {
    const { commands, messages, hand, driver } = driving();
    driver.letGo(25);
    expect(commands.map(({ deadMan, twist }) => [deadMan, twist.linear.x])).toEqual([
      [true, 1],
      [false, 0],
    ]);
    expect(messages).toEqual([{ type: 'leaseRelease' }]);
    // The next robot: the grip is still held.
    driver.reset();
    driver.onLimits({ maxLinear: 1, maxAngular: 1, watchdogMs: 150, maxCommandsPerSecond: 100 });
    driver.onLease({ type: 'lease', holder: 'nobody' });
    for (let now = 50; now < 1000; now += 25) driver.sendDue(now);
    expect([commands.length, messages.length]).toEqual([2, 1]);
    hand.held = false;
    driver.sendDue(1000);
    hand.held = true;
    driver.sendDue(1025);
    expect(messages.at(-1)).toEqual({ type: 'leaseRequest', take: false });
  });

  test('a grip held while the path is lost moves nothing until it is released', () => {
    const { commands, hand, driver } = driving();
    expect(commands.splice(0).map(({ deadMan }) => deadMan)).toEqual([true]);
    driver.onPath(1000);
    for (let now = 1025; now < 5000; now += 25) driver.sendDue(now);
    // The grip is released and pressed again while nothing reaches the robot.
    hand.held = false;
    driver.sendDue(5000);
    hand.held = true;
    driver.sendDue(5025);
    driver.onPath(6000);
    commands.splice(0);
    for (let now = 6025; now < 9000; now += 25) driver.sendDue(now);
    expect(commands.splice(0).every(({ deadMan, twist }) => !deadMan && twist.linear.x === 0)).toBe(true);
    hand.held = false;
    driver.sendDue(9025);
    hand.held = true;
    for (let now = 9050; now < 9150; now += 25) driver.sendDue(now);
    // Zero commands come first: the robot may not have heard that the grip was released.
    expect(commands.filter(({ deadMan }) => deadMan).map(({ twist }) => twist.linear.x)).toEqual([
      0, 0, 1, 1,
    ]);
  });

  test('a headset whose frames stop with the grip held stops the robot, and its commands never look young', () => {
    const commands: Command[] = [];
    const losses: GripLoss[] = [];
    const headset = { name: 'headset', held: true, wish: { forward: 1, left: 0 }, readMs: 0 };
    const driver = new Driver([headset as DriveInput], {
      sendCommand: (command) => commands.push(command),
      sendSession: () => {},
      onOtherDrives: () => {},
      onGripLost: (loss) => losses.push(loss),
    });
    driver.onLimits({ maxLinear: 1, maxAngular: 1, watchdogMs: 150, maxCommandsPerSecond: 100 });
    driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
    const driveOn = (fromMs: number, toMs: number, reads: boolean) => {
      for (let now = fromMs; now < toMs; now += 25) {
        // The last frame comes 14 ms before the command.
        if (reads) headset.readMs = now - 14;
        driver.sendDue(now);
      }
      return commands.splice(0);
    };
    for (const { timeMs, twist } of driveOn(1000, 2000, true)) {
      expect((timeMs - 1000 + 14) % 25).toBe(0);
      expect(twist.linear.x).toBe(1);
    }
    const frozen = driveOn(2000, 7000, false);
    const moving = frozen.filter(({ twist }) => twist.linear.x !== 0);
    expect(moving.map(({ timeMs }) => timeMs)).toEqual(moving.map(() => headset.readMs));
    expect(moving.length).toBeLessThanOrEqual(4);
    expect(frozen.slice(moving.length).map(({ deadMan }) => deadMan)).toEqual([false, false, false, false]);
    expect([losses, driver.lost, driver.input]).toEqual([['late-reading'], 'late-reading', null]);
    // The frames come back and the fist is still closed.
    expect(driveOn(7000, 9000, true)).toEqual([]);
    headset.held = false;
    driveOn(9000, 9025, true);
    headset.held = true;
    expect(driveOn(9025, 9100, true).map(({ twist }) => twist.linear.x)).toEqual([1, 1, 1]);
    expect(driver.lost).toBe(null);
  });

  test('a page that hangs for a moment says that the hand was not read, and drives on; a longer hang does not', () => {
    const { commands, hand, driver } = bench();
    const keys = { name: 'keyboard', held: true, wish: { forward: 1, left: 0 }, readMs: 0 };
    driver.add(keys as DriveInput);
    driver.onLimits({
      ...{ maxLinear: 1, maxAngular: 1, watchdogMs: 150, maxCommandsPerSecond: 100 },
      ...{ afterGap: 'let-go', resumeWithinMs: 400 },
    });
    driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
    expect(hand.held).toBe(false);
    const sentAt = (nowMs: number, reads: boolean) => {
      if (reads) keys.readMs = nowMs;
      driver.sendDue(nowMs);
      return commands
        .splice(0)
        .map(({ deadMan, unread, twist }) => [deadMan, unread ?? false, twist.linear.x]);
    };
    for (let now = 1000; now <= 2000; now += 25) expect(sentAt(now, true)).toEqual([[true, false, 1]]);
    // After the hang the first turn does not count as a reading.
    expect([sentAt(2350, false), driver.paused, driver.lost]).toEqual([[[true, true, 0]], true, null]);
    expect([sentAt(2375, true), driver.paused]).toEqual([[[true, false, 1]], false]);
    // Only the device is silent: a few commands say so, and then none.
    const silent = Array.from({ length: 15 }, (_, i) => sentAt(2400 + i * 25, false)).flat();
    expect(silent).toEqual([
      ...Array.from({ length: 4 }, () => [true, false, 1]),
      ...Array.from({ length: 4 }, () => [true, true, 0]),
    ]);
    // From here on the page counts it as open, and says so.
    expect(sentAt(2776, true)).toEqual([[false, false, 0]]);
    expect([driver.paused, driver.lost, driver.input]).toEqual([false, 'late-reading', null]);
  });

  describe('a robot that it does not drive', () => {
    const noLease = ({ lease, deadMan, twist }: Command) => [lease, deadMan, twist.linear.x];

    test('is told now and then that the hand is open, as long as it is', () => {
      const { commands, hand, driver } = bench();
      for (let now = 0; now < 1500; now += 25) driver.sendDue(now);
      expect(commands.map(noLease)).toEqual(Array(3).fill(['none', false, 0]));
      hand.held = true;
      for (let now = 1500; now < 4000; now += 25) driver.sendDue(now);
      expect(commands).toHaveLength(3);
      driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
      driver.sendDue(4000);
      expect(commands.at(-1)?.lease).toBe('x');
    });

    test('is told nothing before it has said its limits', () => {
      const commands: Command[] = [];
      const driver = new Driver([new WishInput()], {
        sendCommand: (command) => commands.push(command),
        sendSession: () => undefined,
        onOtherDrives: () => undefined,
      });
      for (let now = 0; now < 2000; now += 25) driver.sendDue(now);
      expect(commands).toEqual([]);
    });

    test('does not start when another leaves, with a grip that was closed meanwhile', () => {
      const { messages, commands, hand, driver } = bench();
      driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
      driver.onLease({ type: 'lease', holder: 'other' });
      hand.held = true;
      hand.wish.forward = 1;
      driver.sendDue(0);
      expect(driver.lost).toBe('other-drives');
      driver.onLease({ type: 'lease', holder: 'nobody' });
      for (let now = 25; now < 2000; now += 25) driver.sendDue(now);
      expect([messages, commands]).toEqual([[], []]);
      hand.held = false;
      driver.sendDue(2000);
      hand.held = true;
      driver.sendDue(2025);
      expect(messages).toEqual([{ type: 'leaseRequest', take: false }]);
    });
  });
});
