import { isDeepStrictEqual } from 'node:util';
import { type CaptureBudget, NO_BUDGET } from '../../sense/encode/capture-budget.ts';
import { type BudgetTarget, type SensorDemand, sensorBudget } from './sensor-budget.ts';

export interface BudgetsOptions extends Pick<SensorDemand, 'mayCode'> {
  /** Everybody who may get clouds. */
  targets: () => Iterable<BudgetTarget>;
  /** The operator whose path decides; `null` if nobody drives. */
  driver: () => string | null;
}

/** A sensor whose thread captures what its budget allows. */
export interface BudgetedSensor {
  readonly number: number;
  /** Whether live viewers want its clouds even if no operator does. */
  readonly wantedAnyway: boolean;
  setBudget(budget: CaptureBudget): void;
}

/**
 * Who gets how many bits. A path's rate is divided in three steps: among messages, sound, pictures, videos and clouds
 * (`path-budget.ts`), a path's clouds among sensors (`cloud-shares.ts`), and a sensor's clouds among its operators
 * (`sensor-budget.ts`). Whatever changes one of them calls {@link update}.
 */
export class Budgets {
  readonly #options: BudgetsOptions;
  readonly #sensors = new Map<BudgetedSensor, CaptureBudget>();

  constructor(options: BudgetsOptions) {
    this.#options = options;
  }

  add(sensor: BudgetedSensor): void {
    this.#sensors.set(sensor, NO_BUDGET);
  }

  /** A sensor that captures nothing any more. */
  remove(sensor: BudgetedSensor): void {
    this.#sensors.delete(sensor);
  }

  /** Bytes that the transport adds to each payload of a sensor's clouds. */
  overheadBytes(sensor: BudgetedSensor): number {
    return this.#sensors.get(sensor)?.overheadBytes ?? 0;
  }

  /** Tells each sensor how much to capture and in which formats, if that has changed. */
  update(): void {
    const { targets, driver, mayCode } = this.#options;
    const all = [...targets()];
    const driving = driver();
    for (const [sensor, last] of this.#sensors) {
      const { number, wantedAnyway } = sensor;
      const next = sensorBudget(all, { sensor: number, driver: driving, mayCode, wantedAnyway });
      if (isSame(next, last)) continue;
      this.#sensors.set(sensor, next);
      sensor.setBudget(next);
    }
  }
}

/** A probe's request stays one when its size changes. */
function isSame(a: CaptureBudget, b: CaptureBudget): boolean {
  return (
    a.probe?.clusterId === b.probe?.clusterId &&
    isDeepStrictEqual({ ...a, probe: null }, { ...b, probe: null })
  );
}
