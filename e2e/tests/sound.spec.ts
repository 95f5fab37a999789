import { chromiumLaunchOptions, EmulatedLink, type LocalStack } from '@farpoint/local-stack';
import { toneShare } from '@farpoint/sound/testing';
import type { Page } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { hasSound, soundRobot, toneFile } from '../src/sound-robot.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

test.skip(!hasSound, 'needs GStreamer and `pnpm build:native sound`');

const VOICE_HZ = 900;
const launch = chromiumLaunchOptions();
test.use({
  permissions: ['microphone'],
  launchOptions: {
    ...launch,
    args: [
      ...(launch.args ?? []),
      '--use-fake-ui-for-media-stream',
      '--use-fake-device-for-media-stream',
      `--use-file-for-fake-audio-capture=${toneFile(VOICE_HZ)}`,
    ],
  },
});

const sound = (page: Page) => page.evaluate(() => window.farpoint.sound());
const heard = async (page: Page) => (await sound(page)).heard.state;
const said = async (page: Page) => (await sound(page)).said.state;
const switchOf = (page: Page) => page.getByRole('button', { name: 'Sound', exact: true });

async function metric(stack: LocalStack, name: string): Promise<number> {
  const text = await (await fetch(`${stack.robotAdminUrl(lightRobot.id)}/metrics`)).text();
  return Number(new RegExp(`^farpoint_robot_${name} ([\\d.e+]+)`, 'm').exec(text)?.[1]);
}

async function open(page: Page, stack: LocalStack): Promise<OperatorPage> {
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, canvas: '160x90' });
  await operator.expectPoints(300);
  return operator;
}

/** The operator drives, so that the robot plays its voice. */
async function drive(operator: OperatorPage): Promise<void> {
  await operator.page.evaluate(() => window.farpoint.requestLease());
  await operator.expectState('holder', 'you');
}

async function expectTone(page: Page, frequency: number): Promise<void> {
  await expect.poll(() => heard(page)).toBe('live');
  await expect.poll(async () => Math.abs(((await sound(page)).peakHz ?? 0) - frequency)).toBeLessThan(12);
}

test('the robot is heard while Sound is on, and its microphone is off otherwise', async ({
  page,
  startStack,
}, testInfo) => {
  const robot = soundRobot(lightRobot);
  const stack = await startStack({ robots: [robot.spec] });
  const operator = await open(page, stack);
  await expect(page.locator('#sound')).toContainText('Off');
  expect(await metric(stack, 'sound_packets_total')).toBe(0);
  await switchOf(page).click();
  await expectTone(page, 600);
  await expect.poll(async () => (await sound(page)).level).toBeGreaterThan(0.5);
  await expect(page.locator('#sound')).toContainText('Live');
  expect(await metric(stack, 'sound_listeners')).toBe(1);
  // By the robot's clock, what is played now was captured before.
  await expect.poll(async () => (await sound(page)).delayMs).toBeGreaterThan(0);
  await operator.screenshot(testInfo, 'sound');

  await switchOf(page).click();
  await expect(page.locator('#sound')).toContainText('Off');
  await expect.poll(() => metric(stack, 'sound_bits_per_second')).toBe(0);
  const packets = await metric(stack, 'sound_packets_total');
  await operator.expectFrames(10);
  expect(await metric(stack, 'sound_packets_total')).toBe(packets);
});

test('the driver’s voice comes out of the robot while M is held, and stops when it is released', async ({
  page,
  startStack,
}, testInfo) => {
  const robot = soundRobot(lightRobot);
  const stack = await startStack({ robots: [robot.spec] });
  const operator = await open(page, stack);
  await switchOf(page).click();
  await expectTone(page, 600);

  // Nobody drives yet.
  await page.keyboard.down('m');
  await expect(page.locator('#talk-state')).toContainText('only the driver');
  await page.keyboard.up('m');
  expect(robot.heard()).toHaveLength(0);

  await drive(operator);
  await page.keyboard.down('m');
  await expect(page.locator('#talk-state')).toHaveText('The robot hears you');
  // The tone comes and goes, browsers shape what they take for speech, and a busy machine leaves gaps.
  const tones = () => {
    const played = robot.heard();
    return Array.from({ length: Math.floor(played.length / 3000) }, (_, i) =>
      toneShare(played.subarray(i * 3000, (i + 1) * 3000), VOICE_HZ, 48_000),
    ).filter((share) => share > 0.7).length;
  };
  await expect.poll(tones).toBeGreaterThan(5);
  await operator.screenshot(testInfo, 'voice');
  expect((await sound(page)).heard.text).toBe('Muted while you speak');
  await page.keyboard.up('m');
  await expect.poll(() => said(page)).toBe('off');
  await expect.poll(() => metric(stack, 'voice_open')).toBe(0);
  await operator.expectFrames(5);
  const silent = robot.heard().length;
  await operator.expectFrames(15);
  expect(robot.heard()).toHaveLength(silent);
  await expectTone(page, 600);
});

test('the voice stops when the page loses the focus, although the key is still held', async ({
  page,
  startStack,
}) => {
  const robot = soundRobot(lightRobot);
  const stack = await startStack({ robots: [robot.spec] });
  const operator = await open(page, stack);
  await drive(operator);
  await page.keyboard.down('m');
  await expect.poll(() => said(page)).toBe('live');
  await page.evaluate(() => window.dispatchEvent(new Event('blur')));
  expect((await sound(page)).sending).toBe(false);
  await expect.poll(() => metric(stack, 'voice_open')).toBe(0);
  // Also by the button.
  await page.keyboard.up('m');
  const button = await page.locator('#talk').boundingBox();
  await page.mouse.move((button?.x ?? 0) + 10, (button?.y ?? 0) + 10);
  await page.mouse.down();
  await expect.poll(() => said(page)).toBe('live');
  await page.mouse.up();
  expect((await sound(page)).sending).toBe(false);
});

test('over a link that loses packets, both are heard', async ({ page, startStack }) => {
  const robot = soundRobot(lightRobot);
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, {
    args: ['--rate-mbps', '5', '--rtt-ms', '40', '--loss', '0.05'],
  });
  try {
    await stack.startRobot({
      ...robot.spec,
      args: [...(robot.spec.args ?? []), '--signaling', link.signalingUrl],
    });
    const operator = await open(page, stack);
    await switchOf(page).click();
    await expectTone(page, 600);
    await drive(operator);
    await page.keyboard.down('m');
    await expect.poll(() => said(page)).toBe('live');
    await expect.poll(() => robot.heard().length).toBeGreaterThan(1.5 * 48_000);
    await expect
      .poll(async () => {
        const text = await (await fetch(`${stack.robotAdminUrl(lightRobot.id)}/metrics`)).text();
        return Number(/voice_packets_total\{outcome="concealed"\} (\d+)/.exec(text)?.[1]);
      })
      .toBeGreaterThan(0);
    await page.keyboard.up('m');
    await expectTone(page, 600);
  } finally {
    await link.stop();
  }
});

test('a robot that is killed is no longer heard and hears nobody; when it is back, it is heard again', async ({
  page,
  startStack,
}) => {
  const robot = soundRobot(lightRobot);
  const stack = await startStack({ robots: [robot.spec] });
  const operator = await open(page, stack);
  await switchOf(page).click();
  await expectTone(page, 600);
  await drive(operator);
  await page.keyboard.down('m');
  await expect.poll(() => said(page)).toBe('live');
  await stack.robot(lightRobot.id).kill();
  await expect.poll(async () => (await sound(page)).sending).toBe(false);
  await expect.poll(() => heard(page)).toBe('waiting');
  await page.keyboard.up('m');
  await stack.restartRobot(lightRobot.id);
  await operator.expectPoints(300);
  await expectTone(page, 600);
});

test('a microphone that fails says why on the page', async ({ page, startStack }) => {
  const robot = soundRobot(lightRobot, 'alsasrc device=hw:99');
  const stack = await startStack({ robots: [robot.spec] });
  await open(page, stack);
  await switchOf(page).click();
  await expect(page.locator('#sound')).toContainText('No sound: the microphone');
});
