import { existsSync, readFileSync } from 'node:fs';
import { availableEncoders } from '@farpoint/video';
import { expect, it } from 'vitest';
import { devVideo } from './dev-video.ts';

const isBuilt = await availableEncoders().then(
  () => true,
  () => false,
);

it('is left out with one sentence where the program is missing', async () => {
  const { args, without } = await devVideo('/nonexistent/farpoint-video');
  expect(args).toEqual(['--pictures-of-cloud']);
  expect(without).toMatch(/^no camera video, JPEG pictures instead: .*; install GStreamer .*$/);
});

it.skipIf(!isBuilt)('is one simulated camera', async () => {
  const { args, without, remove } = await devVideo();
  expect(without).toBeNull();
  const [flag, file = ''] = args;
  expect(flag).toBe('--config');
  const { robot } = JSON.parse(readFileSync(file, 'utf8')) as { robot: { videos: { source: unknown }[] } };
  expect(robot.videos).toMatchObject([{ source: { kind: 'sim' } }]);
  remove();
  expect(existsSync(file)).toBe(false);
});
