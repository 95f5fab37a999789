import { monotonicMs } from '../clock.ts';
import type { GraphOptions } from '../ros/open-graph.ts';
import type { CloudShmOptions } from './cloud-shm-source.ts';
import type { FrameSource } from './frame-source.ts';
import type { PcdSourceOptions } from './pcd-source.ts';
import type { RecordingSourceOptions } from './recording-source.ts';
import type { ReferenceShmOptions } from './reference-shm-source.ts';
import type { RgbdSourceOptions } from './rgbd-source.ts';
import type { RosSourceOptions } from './ros-source.ts';
import type { SimLidarSourceOptions } from './sim-lidar-source.ts';
import type { SimSourceOptions } from './sim-source.ts';

/** Which source to open. Plain data, so that it can be passed to the worker. */
export type SourceOptions =
  | ({ kind: 'sim' } & SimSourceOptions)
  | ({ kind: 'sim-lidar' } & SimLidarSourceOptions)
  | ({ kind: 'pcd' } & PcdSourceOptions)
  | ({ kind: 'rgbd' } & RgbdSourceOptions)
  | ({ kind: 'recording' } & RecordingSourceOptions)
  | ({ kind: 'ros'; graph: GraphOptions } & RosSourceOptions)
  | ({ kind: 'shm'; layout: 'farpoint' } & CloudShmOptions)
  | ({ kind: 'shm'; layout: 'reference' } & ReferenceShmOptions);

/**
 * Loads only what this source needs: a robot without ROS need not read all of its message definitions at each start.
 *
 * @throws {Error} naming what could not be opened and why
 */
export async function openSource(options: SourceOptions): Promise<FrameSource> {
  switch (options.kind) {
    case 'sim': {
      const { SimSource } = await import('./sim-source.ts');
      const source = await SimSource.create(options);
      const { triggerPerS } = options;
      if (triggerPerS === undefined) return source;
      const { TriggeredSource } = await import('./triggered-source.ts');
      return new TriggeredSource(source, triggerPerS);
    }
    case 'sim-lidar': {
      const { SimLidarSource } = await import('./sim-lidar-source.ts');
      return SimLidarSource.create(options);
    }
    case 'pcd': {
      const { openPcdSource } = await import('./pcd-source.ts');
      return openPcdSource(options);
    }
    case 'rgbd': {
      const { openRgbdSource } = await import('./rgbd-source.ts');
      return openRgbdSource(options);
    }
    case 'recording': {
      const { RecordingSource } = await import('./recording-source.ts');
      return RecordingSource.open(options, monotonicMs);
    }
    case 'ros': {
      const [{ openGraph }, { wallNs }, { RosSource }] = await Promise.all([
        import('../ros/open-graph.ts'),
        import('../ros/wall-clock.ts'),
        import('./ros-source.ts'),
      ]);
      const graph = await openGraph(options.graph, 'capture');
      return RosSource.open(graph, options, { now: monotonicMs, wallNs });
    }
    case 'shm': {
      if (options.layout === 'reference') {
        const { ReferenceShmSource } = await import('./reference-shm-source.ts');
        return ReferenceShmSource.open(options, monotonicMs);
      }
      const { CloudShmSource } = await import('./cloud-shm-source.ts');
      return CloudShmSource.open(options, monotonicMs);
    }
  }
}
