/** The parts of the process that a command may use. */
export interface CommandRim {
  stdout: { write(text: string): unknown };
  stderr: { write(text: string): unknown };
  /** Milliseconds since 1970. */
  now(): number;
}

/** A mistake in the arguments, or a file that cannot be used: one line for people. */
export class CommandError extends Error {
  override readonly name = 'CommandError';
  /** 2 for a mistake in the arguments, 1 for anything else. */
  readonly status: 1 | 2;

  constructor(message: string, status: 1 | 2 = 2) {
    super(message);
    this.status = status;
  }
}
