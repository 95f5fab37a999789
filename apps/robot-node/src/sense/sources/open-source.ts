import type { FrameSource, Mounted } from '@farpoint/cloud-source';
import { monotonicMs } from '../../ground/clock.ts';
import { type GraphOptions, openGraph } from '../../ground/ros/open-graph.ts';
import { wallNs } from '../../ground/wall-clock.ts';
import { type CloudShmOptions, CloudShmSource } from './cloud-shm-source.ts';
import { openPcdSource, type PcdSourceOptions } from './pcd-source.ts';
import { RecordingSource, type RecordingSourceOptions } from './recording-source.ts';
import { type ReferenceShmOptions, ReferenceShmSource } from './reference-shm-source.ts';
import { openRgbdSource, type RgbdSourceOptions } from './rgbd-source.ts';
import { RosSource, type RosSourceOptions } from './ros-source.ts';
import { SimLidarSource, type SimLidarSourceOptions } from './sim-lidar-source.ts';
import { SimSource, type SimSourceOptions } from './sim-source.ts';
import { TriggeredSource } from './triggered-source.ts';

/** Which source to open. Plain data, so that it can be passed to the worker. */
export type SourceOptions =
  | ({ kind: 'sim' } & SimSourceOptions)
  | ({ kind: 'sim-lidar' } & SimLidarSourceOptions)
  | (RealSourceOptions & Mounted);

/** Sources whose sensors sit where nobody but the configuration may know. */
type RealSourceOptions =
  | ({ kind: 'pcd' } & PcdSourceOptions)
  | ({ kind: 'rgbd' } & RgbdSourceOptions)
  | ({ kind: 'recording' } & RecordingSourceOptions)
  | ({ kind: 'ros'; graph: GraphOptions } & RosSourceOptions)
  | ({ kind: 'shm'; layout: 'farpoint' } & CloudShmOptions)
  | ({ kind: 'shm'; layout: 'reference' } & ReferenceShmOptions);

/** @throws {Error} naming what could not be opened and why */
export async function openSource(options: SourceOptions): Promise<FrameSource> {
  switch (options.kind) {
    case 'sim': {
      const source = await SimSource.create(options);
      const { triggerPerS } = options;
      return triggerPerS === undefined ? source : new TriggeredSource(source, triggerPerS);
    }
    case 'sim-lidar':
      return SimLidarSource.create(options);
    case 'pcd':
      return openPcdSource(options);
    case 'rgbd':
      return openRgbdSource(options);
    case 'recording':
      return RecordingSource.open(options, monotonicMs);
    case 'ros':
      return RosSource.open(await openGraph(options.graph, 'capture'), options, { now: monotonicMs, wallNs });
    case 'shm':
      return options.layout === 'reference'
        ? ReferenceShmSource.open(options, monotonicMs)
        : CloudShmSource.open(options, monotonicMs);
  }
}
