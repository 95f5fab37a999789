import type { RosGraph } from '@farpoint/ros';
import { type GraphOptions, openGraph } from '../../../ground/ros/open-graph.ts';

/** The ROS graphs of a thread: each is joined once, when the first of its topics is needed. */
export class Graphs {
  readonly #open: (options: GraphOptions) => Promise<RosGraph>;
  readonly #graphs = new Map<string, Promise<RosGraph>>();

  constructor(open = (options: GraphOptions) => openGraph(options, 'video')) {
    this.#open = open;
  }

  /** @throws {RosFault} if it cannot be joined; the next call tries again */
  async join(options: GraphOptions): Promise<RosGraph> {
    const key = JSON.stringify(options);
    const joined = this.#graphs.get(key) ?? this.#open(options);
    this.#graphs.set(key, joined);
    try {
      return await joined;
    } catch (error) {
      this.#graphs.delete(key);
      throw error;
    }
  }

  async close(): Promise<void> {
    const graphs = await Promise.allSettled(this.#graphs.values());
    await Promise.all(
      graphs.map((graph) => (graph.status === 'fulfilled' ? graph.value.close() : undefined)),
    );
  }
}
