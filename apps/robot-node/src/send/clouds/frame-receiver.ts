import type { CodedStream } from '../../sense/encode/coded-frame-encoder.ts';
import type { CodedFormat, DrawnMost } from '../../sense/encode/plan.ts';
import { type CloudClaim, cloudShare, probingSensor } from '../budgets/cloud-shares.ts';
import { PathBudget } from '../budgets/path-budget.ts';
import type { SharedFrame } from '../transport/shared-frame.ts';
import type { StreamSender } from '../transport/stream-sender.ts';
import type { FrameTarget } from './pipeline.ts';
import { WantedClouds } from './wanted-clouds.ts';

/**
 * Who gets frames over a path of its own: an operator, one of the reference system, or a broadcast. Says what the
 * receiver wants and how much of its path each stream may take; what becomes of a frame, each kind decides itself.
 */
export abstract class FrameReceiver implements FrameTarget {
  abstract readonly id: string;
  abstract readonly streaming: boolean;
  /** `null` while there is no path. */
  sender: StreamSender | null = null;
  protected readonly clouds = new WantedClouds();
  protected readonly budget: PathBudget;
  readonly #claims: () => readonly CloudClaim[];

  /**
   * @param claims what the robot's cloud sensors claim of a path, indexed by sensor number
   * @param pictureShare the largest share of the path that pictures may take, 0–1
   */
  constructor(claims: () => readonly CloudClaim[], pictureShare = 0) {
    this.#claims = claims;
    this.budget = new PathBudget(pictureShare);
  }

  abstract enqueue(shared: SharedFrame): void;

  announce?(stream: CodedStream, sensor: number): void;

  get display(): DrawnMost | null {
    return this.clouds.pace.display;
  }

  wants(sensor: number): boolean {
    return this.clouds.sensors.has(sensor);
  }

  /** Formats are independent: reading one implies no other. */
  reads(format: CodedFormat): boolean {
    return this.clouds.formats.has(format);
  }

  probesWith(sensor: number): boolean {
    return probingSensor(this.#claims(), this.clouds.sensors) === sensor;
  }

  /** How much of the path a sensor's points may take, bit/s on the wire; 0 while there is no path. */
  cloudBitsPerSecond(sensor: number): number {
    if (this.sender === null) return 0;
    const total = this.cloudPart(this.sender.targetBitsPerSecond) * this.sender.fit;
    return cloudShare(sensor, total, this.#claims(), this.clouds.sensors);
  }

  /** How much of the path a video may take, bit/s without headers; 0 while there is no path. */
  videoBitsPerSecond(video: number): number {
    return this.sender === null ? 0 : this.budget.videoBitsPerSecond(video, this.sender.targetBitsPerSecond);
  }

  /** What of the path's target rate is left for all clouds, bit/s on the wire. */
  protected cloudPart(targetBitsPerSecond: number): number {
    return this.budget.cloudBitsPerSecond(targetBitsPerSecond);
  }
}
