/** Where a ROS source’s frames come from: a topic of clouds, or one of depth and one of colour. */
import type { CloudAxes, Pinhole, RosFault } from '@farpoint/ros';
import type { CaptureRoom } from './frame-source.ts';
import type { Listener } from './ros-listener.ts';

/** What all frames of a feed have in common. */
export interface FeedShape {
  width: number;
  height: number;
  /** Most points of a frame. */
  capacity: number;
  /** Of frames that come as images. */
  camera: Pinhole | null;
  axes: CloudAxes;
}

/** Of one frame, what is not in the room that it was put into. */
export interface FedFrame {
  /** How many points; of images, how many pixels. */
  count: number;
  frameId: string;
  stampNs: bigint;
  /** Robot’s clock, ms. */
  receivedMs: number;
}

export interface RosFeed {
  readonly listeners: readonly Listener[];
  /** Known once the first frame is there. */
  readonly shape: FeedShape | null;
  /** Called at each new frame, which takes the place of one that is still there. */
  onFrame: (() => void) | null;
  onFault: ((fault: RosFault) => void) | null;
  /** Puts the newest frame into the room; `null` where there is none. @throws {RosFault} where it cannot be read */
  take(room: CaptureRoom): FedFrame | null;
  /** Lets it go. */
  skip(): void;
  close(): void;
}
