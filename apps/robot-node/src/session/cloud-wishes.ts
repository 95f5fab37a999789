import type { CloudFormat } from '@farpoint/protocol';
import type { CodedFormat } from '../encode/plan.ts';
import type { OperatorWishes } from './operator-wishes.ts';
import { PaintedHints } from './painted-hints.ts';

export interface CloudWishesEvents {
  /** The operator may need the streams' headers. */
  onCloudFormats(): void;
  onBudgetChanged(): void;
}

/** Which clouds an operator wants, and in which form. */
export class CloudWishes {
  /** The sensors whose clouds the operator wants. */
  sensors: ReadonlySet<number> = new Set([0]);
  /** The coded formats that the operator says it reads. */
  #formats: ReadonlySet<CloudFormat> = new Set();
  readonly #painted = new PaintedHints();
  readonly #now: () => number;

  constructor(wishes: OperatorWishes, events: CloudWishesEvents, now: () => number) {
    this.#now = now;
    wishes.onSensors = (sensors) => {
      this.sensors = new Set(sensors);
      events.onCloudFormats();
      events.onBudgetChanged();
    };
    wishes.onCloudFormats = (formats) => {
      this.#formats = new Set(formats);
      events.onCloudFormats();
      events.onBudgetChanged();
    };
    wishes.onPainted = (sensors) => {
      this.#painted.take(sensors, now());
      events.onBudgetChanged();
    };
  }

  /** Whether the operator reads this format. Formats are independent: reading one implies no other. */
  reads(format: CodedFormat): boolean {
    return this.#formats.has(format);
  }

  /** Whether the operator paints this sensor's clouds with a video now. */
  paints(sensor: number): boolean {
    return this.#painted.has(sensor, this.#now());
  }
}
