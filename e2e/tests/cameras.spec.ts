/** Cameras on USB and in a network in the page. */
import { RtspCamera } from '@farpoint/video/testing/rtsp';
import { V4l2Camera } from '@farpoint/video/testing/v4l2';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';
import { hasVideo, testCamera, videoRobot } from '../src/video-robot.ts';

test.skip(!hasVideo, 'needs GStreamer and `pnpm build:native video`');
for (const { skip, note } of [RtspCamera.suite, V4l2Camera.suite]) test.skip(skip, note);

test('cameras on USB and in a network are shown live; one that goes off says so, and comes back', async ({
  page,
  startStack,
}, testInfo) => {
  const usb = new V4l2Camera();
  let network = await RtspCamera.start('h264', 0, ['robot', 'secret']);
  try {
    const small = { width: 320, height: 240, framesPerS: 15, kbitPerS: 400 };
    const cameras = [
      testCamera('Gate', 'vp8enc', { ...small, source: { kind: 'rtsp', url: network.url('robot:secret') } }),
      testCamera('Arm', 'vp8enc', { ...small, source: { kind: 'v4l2', device: usb.device } }),
    ];
    const stack = await startStack({
      robots: [videoRobot(lightRobot, cameras)],
      env: usb.environment,
    });
    const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, canvas: '160x90' });
    await operator.expectPoints(300);
    const frames = async (name: string) => {
      const videos = await page.evaluate(() => window.farpoint.videos());
      return videos.find((video) => video.name === name)?.frames ?? 0;
    };
    const expectLive = async (name: string) => {
      const before = await frames(name);
      await expect
        .poll(() => frames(name), { message: `pictures of ${name}`, timeout: 30_000 })
        .toBeGreaterThan(before + 10);
    };
    const panel = (name: string) => page.locator('#pictures figure', { hasText: name });
    for (const { name } of cameras) {
      await expectLive(name);
      await expect(panel(name).locator('canvas')).toBeVisible();
    }
    await operator.look(testInfo, 'cameras');

    await network.kill();
    await expect(panel('Gate')).toContainText('the source gives no pictures', { timeout: 30_000 });
    await expect(panel('Gate')).not.toContainText('secret');
    await operator.look(testInfo, 'camera-off');
    await expectLive('Arm');
    network = await RtspCamera.start('h264', network.port, ['robot', 'secret']);
    await expectLive('Gate');
    await expect(panel('Gate')).not.toContainText('the source gives no pictures');
  } finally {
    await network.kill();
    usb.remove();
  }
});
