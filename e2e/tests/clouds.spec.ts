import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { OperatorPage } from '../src/operator-page.ts';
import { readPicture } from '../src/picture.ts';
import { cloudsFolder, expect, LONG, test } from '../src/stack-test.ts';

const recordings = [
  { name: 'kinect-room', args: ['--source', 'pcd', '--path', join(cloudsFolder, 'kinect-room.pcd')] },
  { name: 'stereo-table', args: ['--source', 'pcd', '--path', join(cloudsFolder, 'stereo-table.pcd')] },
  { name: 'lidar-street', args: ['--source', 'pcd', '--path', join(cloudsFolder, 'lidar-street.pcd')] },
  { name: 'rgbd-sequence', args: ['--source', 'rgbd', '--path', join(cloudsFolder, 'rgbd-sequence')] },
];

for (const { name, args } of recordings) {
  test(
    `a real recording streams and is drawn: ${name}`,
    { tag: name.startsWith('kinect') || name.startsWith('rgbd') ? [] : LONG },
    async ({ page, startStack }, testInfo) => {
      test.skip(!existsSync(cloudsFolder), `no recordings at ${cloudsFolder}`);
      const robot = {
        id: name,
        name,
        args: [...args, '--mode', 'points64', '--fps', '5', '--bitrate-mbps', '40', '--lambda', '0'],
      };
      const stack = await startStack({ robots: [robot] });
      const operator = await OperatorPage.open(page, stack, { robot: name });
      await operator.expectPoints(60_000);
      const picture = await operator.screenshot(testInfo, name);
      const [facts] = await readPicture(page, picture, [{ left: 0, top: 0, width: 1, height: 1 }]);
      expect(facts?.drawnShare).toBeGreaterThan(0.15);
      expect(facts?.colours).toBeGreaterThan(10);
    },
  );
}
