/** Where a ROS source's frames come from: a topic of clouds, or topics of depth and colour images. */

import type { CaptureRoom } from '@farpoint/cloud-source';
import type { CloudAxes, Pinhole, RosFault } from '@farpoint/ros';
import type { Listener } from '../../ground/ros/ros-listener.ts';

/** Properties shared by all frames of a feed. */
export interface FeedShape {
  width: number;
  height: number;
  /** Maximum number of points in a frame. */
  capacity: number;
  /** The camera of frames that come as images. */
  camera: Pinhole | null;
  axes: CloudAxes;
}

/** Facts about a frame whose data was put into the room. */
export interface FedFrame {
  /** Number of points; for images, number of pixels. */
  count: number;
  frameId: string;
  stampNs: bigint;
  /** Robot’s clock, ms. */
  receivedMs: number;
}

export interface RosFeed {
  readonly listeners: readonly Listener[];
  /** `null` until the first frame arrives. */
  readonly shape: FeedShape | null;
  /** Elevations of its LiDAR's rings, radians, ascending, once they are known. */
  readonly rings?: readonly number[] | null;
  /** Called at each new frame, which replaces one that has not been taken. */
  onFrame: (() => void) | null;
  onFault: ((fault: RosFault) => void) | null;
  /** Puts the newest frame into the room; `null` if there is none. @throws {RosFault} if it cannot be read */
  take(room: CaptureRoom): FedFrame | null;
  /** Discards the newest frame. */
  skip(): void;
  close(): void;
}
