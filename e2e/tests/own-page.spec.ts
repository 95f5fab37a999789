import { installOwnPage, serveFolder, typeFaults } from '../src/own-page.ts';
import { readPicture } from '../src/picture.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

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

test('a custom page drives a robot with the packages from their tarballs', async ({
  page,
  startStack,
}, testInfo) => {
  const folder = testInfo.outputPath('own-page');
  await installOwnPage(folder);
  expect(await typeFaults(folder, TYPED)).toBe('');
  const server = await serveFolder(folder);
  try {
    const stack = await startStack();
    const faults: string[] = [];
    page.on('pageerror', (error) => faults.push(String(error)));
    const address = new URL(server.url);
    address.searchParams.set('signaling', stack.signalingUrl);
    address.searchParams.set('robot', simulatedRobot.id);
    await page.goto(address.href);

    const view = () =>
      page.evaluate(() => {
        const { drawn, frames } = (globalThis as unknown as OwnPage).view;
        return { drawn, frames };
      });
    await expect.poll(async () => (await view()).drawn, { message: 'points drawn' }).toBeGreaterThan(1000);
    const { frames } = await view();
    await expect.poll(async () => (await view()).frames, { message: 'frames' }).toBeGreaterThan(frames + 5);
    const canvas = await page.locator('canvas').screenshot({ path: testInfo.outputPath('own-page.png') });
    const [room] = await readPicture(page, canvas, [{ left: 0, top: 0, width: 1, height: 1 }]);
    expect(room?.drawnShare).toBeGreaterThan(0.3);
    expect(room?.colours).toBeGreaterThan(20);

    const telemetry = () =>
      page.evaluate(() => {
        const { telemetry: newest } = (globalThis as unknown as OwnPage).robot;
        if (newest === null) return null;
        return { ...newest.pose.position, speed: newest.twist.linear.x, drive: newest.drive };
      });
    await expect.poll(telemetry, { message: 'telemetry' }).not.toBe(null);
    const start = await telemetry();
    await page.keyboard.down('KeyW');
    await expect
      .poll(
        async () => {
          const now = await telemetry();
          // After a gap, as a busy machine makes them, the robot waits for the hand to let go.
          if (now?.drive === 'watchdog') {
            await page.keyboard.up('KeyW');
            await expect.poll(async () => (await telemetry())?.drive).toBe('idle');
            await page.keyboard.down('KeyW');
          }
          return Math.hypot((now?.x ?? 0) - (start?.x ?? 0), (now?.y ?? 0) - (start?.y ?? 0));
        },
        { message: 'metres driven' },
      )
      .toBeGreaterThan(0.5);
    await page.keyboard.up('KeyW');
    await expect.poll(async () => (await telemetry())?.speed, { message: 'speed' }).toBe(0);

    await page.locator('#stop').click();
    const latched = () =>
      page.evaluate(() => (globalThis as unknown as OwnPage).robot.link.session.estop.latched);
    await expect.poll(latched, { message: 'emergency stop' }).toBe(true);
    expect(faults).toEqual([]);
  } finally {
    server.close();
  }
});
