import { officeWorld, SimulatedBase } from '@farpoint/sim';
import { afterEach, expect, it, vi } from 'vitest';
import { makeSharedSnapshot, SnapshotWriter } from '../../base/shared-snapshot.ts';
import { SimSource } from '../../sources/sim-source.ts';
import { SimVideoCameras } from './sim-video-feed.ts';

afterEach(() => vi.useRealTimers());

it('shows, pixel by pixel, what the depth camera’s cloud shows, of the same instant of the world', async () => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout', 'hrtime'] });
  const base = new SimulatedBase(officeWorld());
  const snapshot = makeSharedSnapshot(base.world.movers.length);
  const writer = new SnapshotWriter(snapshot);
  const size = 64;
  const [seed, camera] = [7, { width: size, height: size }];
  const source = await SimSource.create({ seed, size, snapshot });
  const pictures: Uint8Array[] = [];
  const feed = await new SimVideoCameras().open(
    { kind: 'sim', camera, framesPerS: 10, seed, snapshot },
    {
      takes: true,
      pushFrame: ({ bytes }) => pictures.push(bytes.slice()) > 0,
      pushCoded: () => false,
    },
  );
  for (let frame = 0; frame < 3; frame++) {
    base.setCommand({ linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.8 } });
    for (let step = 0; step < 25; step++) base.step(0.02);
    writer.write(base.snapshot);
    vi.advanceTimersByTime(100);
    const { colour } = source.capture(0);
    expect(pictures).toHaveLength(frame + 1);
    expect(pictures[frame]).toEqual(new Uint8Array(colour.slice().buffer));
  }
  expect(pictures[0]).not.toEqual(pictures[2]);
  feed.close();
  source.close();
});
