/** Why the simulation refused something. */
export type SimulationErrorCode =
  | 'not-finite' // a number was NaN or infinite
  | 'out-of-range' // a number without meaning, such as a negative duration
  | 'bad-world' // a world description contradicts itself
  | 'bad-camera'; // the camera refused its configuration or the scene

/** The only error this package throws for bad input. */
export class SimulationError extends Error {
  override readonly name = 'SimulationError';
  readonly code: SimulationErrorCode;
  /** What was refused, for example `twist.linear.x`. */
  readonly what: string;

  constructor(code: SimulationErrorCode, what: string, detail: string) {
    super(`${what}: ${detail}`);
    this.code = code;
    this.what = what;
  }
}

/** Returns `value`, or throws `not-finite`. */
export function requireFinite(value: number, what: string): number {
  if (!Number.isFinite(value))
    throw new SimulationError('not-finite', what, `${value} is not a finite number`);
  return value;
}
