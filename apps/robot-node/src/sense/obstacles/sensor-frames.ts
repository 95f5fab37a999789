/** In the guard's own thread: where tf says that the guard's scanners sit. */
import type { Pose } from '@farpoint/protocol';
import { type RosFault, type RosGraph, type TopicTable, WorldState } from '@farpoint/ros';
import type { RosClock } from '../../ground/ros/capture-time.ts';
import { listen } from '../../ground/ros/ros-listener.ts';
import { StampClock } from '../../ground/ros/stamp-clock.ts';

/** Of tf: as many as a robot's joints publish while the thread does something else. */
const QUEUE = 100;

/** Which topics of the graph say where frames are, and the frame of the robot's base; `null`: as tf names it. */
export interface FrameTopics {
  topics: TopicTable;
  base: string | null;
}

export class SensorFrames {
  readonly #world: WorldState;
  /** When the message came that is being read. */
  #receivedMs = 0;

  constructor(
    graph: RosGraph,
    { topics, base }: FrameTopics,
    clock: RosClock,
    onFault: (fault: RosFault) => void,
  ) {
    const stamps = new StampClock(clock);
    this.#world = new WorldState(
      {
        of: (source, stampNs, mayBeAhead) =>
          stamps.ofTransform(source, stampNs, this.#receivedMs, mayBeAhead),
      },
      base,
    );
    for (const entry of topics) {
      const { topic: name, type } = entry;
      // What is wrong with these messages is told by the thread that takes the clouds.
      listen(graph, entry, { queue: QUEUE, limited: false, onFault }, (message, receivedMs) => {
        this.#receivedMs = receivedMs;
        this.#world.take({ name, type }, message);
      });
    }
  }

  /** A frame in that of the base, at a time of the robot's clock, ms; `null` if tf does not say it. */
  mountOf(frameId: string, atMs: number): Pose | null {
    // Axes that are not turned: the frame's own.
    return this.#world.place(frameId, atMs, 'optical').mount;
  }
}
