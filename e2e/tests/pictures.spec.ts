import { writeFileSync } from 'node:fs';
import { EmulatedLink } from '@farpoint/local-stack';
import { openRecording } from '@farpoint/recording';
import { foxgloveCompressedImageSchema } from '@farpoint/ros';
import type { Page } from '@playwright/test';
import { enterVr, Headset } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { readPicture } from '../src/picture.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

const panel = (page: Page, name: string) => page.locator('#pictures figure', { hasText: name });
const camera = async (page: Page, name: string) => {
  const found = (await page.evaluate(() => window.farpoint.cameras())).find((each) => each.name === name);
  if (found === undefined) throw new Error(`no camera ${name}`);
  return found;
};

/** Colours of the panel's canvas at shares of its width, at half its height. */
const colours = (page: Page, name: string, places: number[]) =>
  panel(page, name)
    .locator('canvas')
    .evaluate((element, at) => {
      const canvas = element as HTMLCanvasElement;
      const context = canvas.getContext('2d') as CanvasRenderingContext2D;
      return at.map((x) => [
        ...context.getImageData(Math.floor(x * canvas.width), canvas.height >> 1, 1, 1).data.slice(0, 3),
      ]);
    }, places);

/** The same for JPEG files. */
const coloursOfFiles = (page: Page, files: Uint8Array[], places: number[]) =>
  page.evaluate(
    async ({ texts, at }) => {
      const rows: number[][][] = [];
      for (const text of texts) {
        const picture = await createImageBitmap(await (await fetch(`data:image/jpeg;base64,${text}`)).blob());
        const context = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
        context?.drawImage(picture, 0, 0);
        rows.push(
          at.map((x) => {
            const [column, row] = [Math.floor(x * picture.width), picture.height >> 1];
            return [...(context?.getImageData(column, row, 1, 1).data.slice(0, 3) ?? [])];
          }),
        );
      }
      return rows;
    },
    { texts: files.map((file) => Buffer.from(file).toString('base64')), at: places },
  );

async function recordedPictures(path: string, topic: string): Promise<Uint8Array[]> {
  const recording = await openRecording(path);
  const files: Uint8Array[] = [];
  for await (const { topic: of, data } of recording.messages([topic], recording.startNs))
    files.push(foxgloveCompressedImageSchema.parse(of.decode(data)).data.slice());
  await recording.close();
  return files;
}

const SIZE = { width: 200, height: 200 };
const withCamera = {
  ...simulatedRobot,
  args: [...simulatedRobot.args, '--pictures-of-cloud', '--sim-size', String(SIZE.width)],
};

test('the simulated camera’s picture is shown, live, and can be hidden', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [withCamera] });
  const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
  await operator.expectPoints();
  await expect(panel(page, 'Camera').locator('canvas')).toBeVisible();
  await expect.poll(async () => (await camera(page, 'Camera')).pictures).toBeGreaterThan(5);
  expect(await camera(page, 'Camera')).toMatchObject({ ...SIZE, failures: 0 });
  const places = Array.from({ length: 40 }, (_, i) => (i + 0.5) / 40);
  const seen = await colours(page, 'Camera', places);
  expect(new Set(seen.map((colour) => colour.map((value) => value >> 4).join())).size).toBeGreaterThan(5);
  await operator.look(testInfo, 'picture');

  // The robot's view changes as it turns.
  await page.evaluate(() => window.farpoint.requestLease());
  await operator.expectState('holder', 'you');
  await page.evaluate(() => window.farpoint.drive({ forward: 0, left: 1 }, 1500));
  await expect
    .poll(async () => {
      const now = await colours(page, 'Camera', places);
      return now.flat().reduce((sum, value, i) => sum + Math.abs(value - (seen.flat()[i] as number)), 0);
    })
    .toBeGreaterThan(1000);

  // A hidden picture is not sent either.
  await page.getByRole('button', { name: 'Hide Camera' }).click();
  await expect(panel(page, 'Camera').locator('canvas')).toBeHidden();
  await expect(panel(page, 'Camera').locator('.age')).toHaveText('hidden');
  const sent = async () => {
    const text = await (await fetch(`${stack.robotAdminUrl(simulatedRobot.id)}/metrics`)).text();
    return Number(/^farpoint_robot_pictures_made_total (\d+)/m.exec(text)?.[1]);
  };
  await expect
    .poll(async () => {
      const before = await sent();
      await operator.expectFrames(30);
      return (await sent()) - before;
    })
    .toBe(0);
  const { pictures } = await camera(page, 'Camera');
  await page.getByRole('button', { name: 'Show Camera' }).click();
  await expect.poll(async () => (await camera(page, 'Camera')).pictures).toBeGreaterThan(pictures + 2);
});

test('a recording of the robot shows the recorded pictures', async ({ page, startStack }, testInfo) => {
  const path = testInfo.outputPath('drive.mcap');
  const places = Array.from({ length: 40 }, (_, i) => (i + 0.5) / 40);
  const recorded = await startStack({
    robots: [{ ...withCamera, args: [...withCamera.args, '--record', path] }],
  });
  const driver = await OperatorPage.open(page, recorded, { robot: simulatedRobot.id });
  await driver.expectPoints();
  await expect.poll(async () => (await camera(page, 'Camera')).pictures).toBeGreaterThan(3);
  await page.evaluate(() => window.farpoint.requestLease());
  await driver.expectState('holder', 'you');
  await page.evaluate(() => window.farpoint.drive({ forward: 0, left: 1 }, 2000));
  await recorded.stop();
  const files = await recordedPictures(path, '/farpoint/pictures/Camera');
  expect(files.length).toBeGreaterThan(5);

  const config = testInfo.outputPath('farpoint.yaml');
  const topics = [
    { topic: '/farpoint/pictures/Camera', as: 'picture', label: 'Front' },
    { topic: '/farpoint/pictures/Rear', as: 'picture', label: 'Rear' },
    { topic: '/farpoint/telemetry', as: 'text', type: 'std_msgs/String', label: 'Recorded' },
  ];
  writeFileSync(config, JSON.stringify({ robot: { source: { kind: 'recording', path }, topics } }));
  // A rate at which the files pass unchanged.
  const args = ['--config', config, '--mode', 'points64', '--max-points', '15000', '--rate-control', 'fixed'];
  const stack = await startStack({ robots: [{ id: 'played-1', name: 'A recording', args }] });
  const operator = await OperatorPage.open(page, stack, { robot: 'played-1' });
  await operator.expectPoints();
  await expect.poll(async () => (await camera(page, 'Front')).pictures).toBeGreaterThan(3);
  expect(await camera(page, 'Front')).toMatchObject({ ...SIZE, failures: 0 });

  // The panel shows one of them, exact to the pixel, and later another.
  const rows = (await coloursOfFiles(page, files, places)).map((row) => row.join(' '));
  const seen = new Set<number>();
  await expect
    .poll(async () => {
      const shown = (await colours(page, 'Front', places)).join(' ');
      expect(rows).toContain(shown);
      return seen.add(rows.indexOf(shown)).size;
    })
    .toBeGreaterThan(3);
  await expect(page.locator('#facts dt', { hasText: 'Recorded' }).locator('+ dd')).toContainText('x');
  await operator.look(testInfo, 'recorded-picture');
  // A camera that the recording lacks does not prevent playback.
  await expect(panel(page, 'Rear').locator('.age')).toHaveText('waiting');
});

test('over a link of 3 Mbit/s, pictures are small and clouds keep their share', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, {
    args: ['--rate-mbps', '3', '--rtt-ms', '40', '--queue-ms', '200', '--loss', '0.01'],
  });
  try {
    const args = ['--pictures-of-cloud', '--signaling', link.signalingUrl];
    await stack.startRobot({ ...simulatedRobot, args: [...simulatedRobot.args, ...args] });
    const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
    await operator.expectPoints();
    const metric = async (name: string) => {
      const text = await (await fetch(`${stack.robotAdminUrl(simulatedRobot.id)}/metrics`)).text();
      return Number(new RegExp(`^farpoint_robot_${name} (\\S+)`, 'm').exec(text)?.[1]);
    };
    await expect.poll(async () => (await camera(page, 'Camera')).pictures).toBeGreaterThan(10);
    const [ofPictures, ofClouds] = [await metric('picture_bytes_sent'), await metric('bytes_sent')];
    const share = ofPictures / (ofPictures + ofClouds);
    expect(share).toBeLessThan(0.16);
    expect((await operator.stats()).framesPerSecond).toBeGreaterThan(5);
  } finally {
    await link.stop();
  }
});

test.describe('on a phone held upright', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test('pictures are on the screen and cover no control', async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [withCamera] });
    const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
    await operator.expectPoints();
    await expect.poll(async () => (await camera(page, 'Camera')).pictures).toBeGreaterThan(1);
    await operator.look(testInfo, 'phone-picture');
    const figure = await panel(page, 'Camera').boundingBox();
    expect(figure).not.toBeNull();
    const { x, y, width, height } = figure!;
    expect(width).toBeGreaterThan(120);
    expect(x).toBeGreaterThanOrEqual(0);
    expect(x + width).toBeLessThanOrEqual(390);
    for (const id of ['#facts-fold', '#joystick', '#estop', '#latency', '#bar']) {
      const box = (await page.locator(id).boundingBox())!;
      const apart =
        x + width <= box.x || box.x + box.width <= x || y + height <= box.y || box.y + box.height <= y;
      expect(apart, id).toBe(true);
    }
    await page.getByRole('button', { name: 'Hide Camera' }).tap();
    await expect(panel(page, 'Camera').locator('canvas')).toBeHidden();
  });
});

test('in the headset the picture is beside the panel on the wrist', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [withCamera] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
  await operator.expectPoints();
  await enterVr(page, operator);
  // Upwards, where there is nothing behind it.
  await headset.place('left', [-0.12, 1.92, -0.45]);
  const drawnAbove = async (name: string) => {
    await operator.expectFrames(20);
    const picture = await operator.screenshot(testInfo, name);
    const [facts] = await readPicture(page, picture, [{ left: 0, top: 0, width: 0.5, height: 0.15 }]);
    return facts?.drawnShare ?? Number.NaN;
  };
  await expect.poll(async () => (await camera(page, 'Camera')).pictures).toBeGreaterThan(2);
  const shown = await drawnAbove('headset-picture');
  await page
    .getByRole('button', { name: 'Hide Camera' })
    .evaluate((button: HTMLButtonElement) => button.click());
  expect(shown - (await drawnAbove('headset-no-picture'))).toBeGreaterThan(0.1);
});

test('pictures from a ROS 1 graph: raw ones are shrunk, a silent camera is marked, a broken one is harmless', async ({
  page,
  openRos1Robot,
}, testInfo) => {
  const { nodes, operator } = await openRos1Robot({
    nodes: [
      ['lidar', 'cloud'],
      ['cameras', 'pictures'],
    ],
    topics: [
      { topic: '/front/image_raw', as: 'picture', label: 'Front' },
      { topic: '/rear/image_raw/compressed', as: 'picture', label: 'Rear' },
    ],
  });
  await expect.poll(async () => (await camera(page, 'Front')).pictures).toBeGreaterThan(3);
  const front = await camera(page, 'Front');
  expect(front.width).toBeLessThanOrEqual(640);
  expect(front.width / front.height).toBeCloseTo(1280 / 960, 1);
  const bars = await colours(page, 'Front', [0.125, 0.375, 0.625, 0.875]);
  const expected = [
    [255, 0, 0],
    [0, 255, 0],
    [0, 0, 255],
    [255, 255, 255],
  ];
  for (const [i, bar] of bars.entries())
    for (const [c, value] of bar.entries())
      expect(Math.abs(value - (expected[i]?.[c] as number)), `bar ${i}`).toBeLessThan(20);

  // The page goes on, and only reports that no picture has arrived.
  await expect.poll(async () => (await camera(page, 'Rear')).failures).toBeGreaterThan(3);
  expect((await camera(page, 'Rear')).pictures).toBe(0);
  await expect(panel(page, 'Rear').locator('.age')).toHaveText('waiting');
  await operator.expectFrames(5);
  await operator.look(testInfo, 'ros-pictures');

  await nodes[1]?.kill();
  await expect(panel(page, 'Front')).toHaveAttribute('data-state', 'frozen');
  await expect(panel(page, 'Front').locator('.age')).toHaveText(/^frozen, \d+\.\d s$/);
  await operator.look(testInfo, 'ros-pictures-stale');
});
