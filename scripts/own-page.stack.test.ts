/** A third party's page in a real browser, with the packages from their tarballs. */

import { CHROMIUM_REMEDY, findChromium, LocalStack, launchChromium } from '@farpoint/local-stack';
import { eventually } from '@farpoint/service/testing/eventually';
import { testFolder } from '@farpoint/service/testing/folder';
import { describe, expect, onTestFinished, test } from 'vitest';
import { installOwnPage, serveFolder, typeFaults } from './lib/own-page.ts';

const MOST_MS = 120_000;
const robot = {
  id: 'own-1',
  name: 'Own robot',
  args: ['--sim-seed', '1', '--mode', 'points64', '--max-points', '6000'],
};

/** What the example's page exposes for this test. */
interface OwnPage {
  robot: {
    telemetry: {
      pose: { position: { x: number; y: number } };
      drive: string;
      twist: { linear: { x: number } };
    } | null;
    link: { session: { estop: { latched: boolean } } };
  };
  view: { drawn: number; frames: number };
}

/** Uses the packages' types as a TypeScript page would. */
const TYPED = `
import { CloudView, RobotWorld } from '@farpoint/cloud-view';
import { type ConnectError, connect, type RobotClient } from '@farpoint/operator';
import { Scene, WebGLRenderer } from 'three';

const robot: RobotClient = connect({ signaling: 'wss://robots.example.org', robot: 'rover-1' });
const view = new CloudView(new WebGLRenderer(), robot);
new Scene().add(new RobotWorld().add(view));
robot.on('telemetry', ({ pose }): number => pose.position.x);
robot.on('robots', ([first]) => first !== undefined && robot.choose(first.id));
export const reason = (error: ConnectError): 'bad-token' | null => (error.reason === 'bad-token' ? error.reason : null);
// @ts-expect-error: there is no such event
robot.on('weather', () => undefined);
// @ts-expect-error: a robot's id is text
robot.choose(1);
// @ts-expect-error: events are not any
robot.on('telemetry', (telemetry): string => telemetry);
`;

describe.skipIf(findChromium() === null)(`needs Chromium: ${CHROMIUM_REMEDY}`, () => {
  test(
    'a page of somebody else’s shows a robot’s world, drives it and stops it',
    async () => {
      const folder = testFolder();
      await installOwnPage(folder);
      expect(await typeFaults(folder, TYPED)).toBe('');
      const server = await serveFolder(folder);
      onTestFinished(() => server.close());
      const stack = await LocalStack.start({ robots: [robot] });
      onTestFinished(() => stack.stop());
      const browser = await launchChromium();
      onTestFinished(() => browser.close());
      const page = await browser.newPage({ viewport: { width: 480, height: 270 } });
      const faults: string[] = [];
      page.on('pageerror', (error) => faults.push(String(error)));
      const address = new URL(server.url);
      address.searchParams.set('signaling', stack.signalingUrl);
      address.searchParams.set('robot', robot.id);
      await page.goto(address.href);

      const view = () =>
        page.evaluate(() => {
          const { drawn, frames } = (globalThis as unknown as OwnPage).view;
          return { drawn, frames };
        });
      await eventually(async () => (await view()).drawn > 1000);
      const { frames } = await view();
      await eventually(async () => (await view()).frames > frames);

      const telemetry = () =>
        page.evaluate(() => {
          const { telemetry: newest } = (globalThis as unknown as OwnPage).robot;
          if (newest === null) return null;
          return { ...newest.pose.position, speed: newest.twist.linear.x, drive: newest.drive };
        });
      const start = await eventually(telemetry);
      await page.keyboard.down('KeyW');
      await eventually(async () => {
        const now = await telemetry();
        // After a gap, as a busy machine makes them, the robot waits for the hand to let go.
        if (now?.drive === 'watchdog') {
          await page.keyboard.up('KeyW');
          await eventually(async () => (await telemetry())?.drive !== 'watchdog');
          await page.keyboard.down('KeyW');
        }
        return Math.hypot((now?.x ?? 0) - start.x, (now?.y ?? 0) - start.y) > 0.2;
      });
      await page.keyboard.up('KeyW');
      await eventually(async () => (await telemetry())?.speed === 0);

      await page.locator('#stop').click();
      await eventually(() =>
        page.evaluate(() => (globalThis as unknown as OwnPage).robot.link.session.estop.latched),
      );
      expect(faults).toEqual([]);
    },
    MOST_MS,
  );
});
