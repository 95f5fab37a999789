import type { TopicReading } from '@farpoint/ros';
import type { Capture } from '../../sense/capture/capture.ts';
import type { CaptureOptions } from '../../sense/capture/capture-messages.ts';
import type { CaptureBudget } from '../../sense/encode/capture-budget.ts';
import type { BudgetedSensor, Budgets } from '../budgets/budgets.ts';
import type { CloudClaim } from '../budgets/cloud-shares.ts';
import { type FrameTarget, SendPipeline, type SendPipelineOptions } from './pipeline.ts';

export interface CloudSensorOptions {
  /** The name that people read. */
  name: string;
  capture: CaptureOptions;
  /** A lower number goes first, on the wire and when the link is shared. */
  priority: number;
  /** Share of the link among sensors of the same priority. */
  weight: number;
}

export interface SensorFanOut
  extends Omit<SendPipelineOptions, 'capture' | 'sensor' | 'lane' | 'overheadBytes'> {
  /** Whether live viewers want the clouds even if no operator does; default: they do not. */
  wantedAnyway?: () => boolean;
}

/** One source of clouds: its capture and encoding thread, and the distribution of its frames to operators. */
export class CloudSensor implements BudgetedSensor {
  /** The sensor's number, in its packets' placement and in the list that operators get. */
  readonly number: number;
  readonly name: string;
  readonly capture: Capture;
  readonly #claim: CloudClaim;
  readonly #pipeline: SendPipeline;
  readonly #budgets: Budgets;
  readonly #wantedAnyway: () => boolean;

  constructor(
    { name, capture: { sensor }, priority, weight }: CloudSensorOptions,
    capture: Capture,
    pipeline: SensorFanOut,
    budgets: Budgets,
  ) {
    this.number = sensor;
    this.name = name;
    this.capture = capture;
    this.#claim = { priority, weight, usefulBitsPerSecond: Number.POSITIVE_INFINITY };
    this.#budgets = budgets;
    this.#wantedAnyway = pipeline.wantedAnyway ?? (() => false);
    this.#pipeline = new SendPipeline({
      ...pipeline,
      overheadBytes: () => budgets.overheadBytes(this),
      capture,
      sensor,
      lane: priority,
      onFrame: (frame) => {
        this.#claim.usefulBitsPerSecond = frame.usefulBitsPerSecond;
        pipeline.onFrame?.(frame);
      },
    });
    budgets.add(this);
  }

  get claim(): Readonly<CloudClaim> {
    return this.#claim;
  }

  get wantedAnyway(): boolean {
    return this.#wantedAnyway();
  }

  setBudget(budget: CaptureBudget): void {
    this.capture.setBudget(budget);
  }

  /** The sensor's thread has ended: its share of the link goes to the others. */
  fail(): void {
    this.#budgets.remove(this);
    this.#claim.usefulBitsPerSecond = 0;
  }

  announceTo(target: FrameTarget): void {
    this.#pipeline.announceTo(target);
  }
}

/** The reading that operators get for a sensor whose thread has ended. */
export function failureReading({ number, name }: CloudSensor): TopicReading {
  const values: [string, string][] = [['', 'no more clouds: its thread has ended']];
  return { topic: `sensor ${number}`, label: name, level: 'error', values };
}
