import type { TopicReading } from '@farpoint/ros';
import type { Capture } from '../../sense/capture/capture.ts';
import type { CaptureOptions } from '../../sense/capture/capture-messages.ts';
import type { CloudClaim } from '../budgets/cloud-shares.ts';
import { type FanOutOptions, FrameFanOut, type FrameTarget } from './frame-fan-out.ts';

export interface CloudSensorOptions {
  /** The name that people read. */
  name: string;
  capture: CaptureOptions;
  /** A lower number goes first, on the wire and when the link is shared. */
  priority: number;
  /** Share of the link among sensors of the same priority. */
  weight: number;
}

/** One source of clouds: its capture and encoding thread, and the distribution of its frames to operators. */
export class CloudSensor {
  /** The sensor's number, in its packets' placement and in the list that operators get. */
  readonly number: number;
  readonly name: string;
  readonly capture: Capture;
  readonly #claim: CloudClaim;
  readonly #fanOut: FrameFanOut;
  #failed = false;

  constructor(
    { name, capture: { sensor }, priority, weight }: CloudSensorOptions,
    capture: Capture,
    fanOut: Omit<FanOutOptions, 'capture' | 'sensor' | 'lane'>,
  ) {
    this.number = sensor;
    this.name = name;
    this.capture = capture;
    this.#claim = { priority, weight, usefulBitsPerSecond: Number.POSITIVE_INFINITY };
    this.#fanOut = new FrameFanOut({
      ...fanOut,
      capture,
      sensor,
      lane: priority,
      onFrame: (frame) => {
        this.#claim.usefulBitsPerSecond = frame.usefulBitsPerSecond;
        fanOut.onFrame?.(frame);
      },
    });
  }

  get claim(): Readonly<CloudClaim> {
    return this.#claim;
  }

  /** The sensor's thread has ended: its share of the link goes to the others. */
  fail(): void {
    this.#failed = true;
    this.#claim.usefulBitsPerSecond = 0;
  }

  updateBudget(): void {
    if (!this.#failed) this.#fanOut.updateBudget();
  }

  announceTo(target: FrameTarget): void {
    this.#fanOut.announceTo(target);
  }
}

/** The reading that operators get for a sensor whose thread has ended. */
export function failureReading({ number, name }: CloudSensor): TopicReading {
  const values: [string, string][] = [['', 'no more clouds: its thread has ended']];
  return { topic: `sensor ${number}`, label: name, level: 'error', values };
}
