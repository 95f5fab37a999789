import type { TopicReading } from '@farpoint/ros';
import type { Capture } from '../capture/capture.ts';
import type { CaptureOptions } from '../capture/capture-messages.ts';
import { type FanOutOptions, FrameFanOut, type FrameTarget } from '../session/frame-fan-out.ts';
import type { CloudClaim } from './cloud-shares.ts';

export interface CloudSensorOptions {
  /** What people read. */
  name: string;
  capture: CaptureOptions;
  /** Lower goes first, on the wire and when the link is shared out. */
  priority: number;
  /** Share of the link among sensors of the same priority. */
  weight: number;
}

/** One source of clouds: a thread that captures and encodes, and what goes from it to operators. */
export class CloudSensor {
  /** Its number, in the placement of its packets and in the list that operators get. */
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
      ...{ capture, sensor, lane: priority },
      onFrame: (frame) => {
        this.#claim.usefulBitsPerSecond = frame.usefulBitsPerSecond;
        fanOut.onFrame?.(frame);
      },
    });
  }

  get claim(): Readonly<CloudClaim> {
    return this.#claim;
  }

  /** Its thread has ended: what it was given goes to the others. */
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

/** What operators read of a sensor whose thread has ended. */
export function failureReading({ number, name }: CloudSensor): TopicReading {
  const values: [string, string][] = [['', 'no more clouds: its thread has ended']];
  return { topic: `sensor ${number}`, label: name, level: 'error', values };
}
