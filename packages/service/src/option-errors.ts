/** One mistake in the options. */
export interface OptionMistake {
  /** As shown to people: `--port`, `FARPOINT_SIGNALING_PORT` or `farpoint.yaml:3: signaling.port`. */
  readonly where: string;
  /** Completes the sentence that begins with `where`, for example `must be a whole number from 0 to 65535`. */
  readonly detail: string;
  /** Path of the configuration file, if the mistake is in one. */
  readonly file?: string;
  /** Line in that file, from 1. */
  readonly line?: number;
  /** Its key in the file (`signaling.port`), its flag or its variable. */
  readonly key?: string;
  /** As JSON, shortened; absent for secrets. */
  readonly found?: string;
}

/** All mistakes in flags, environment and configuration file, each as a sentence that names the place. Exit code 2. */
export class OptionsError extends Error {
  override readonly name = 'OptionsError';
  /** At least one. */
  readonly mistakes: readonly OptionMistake[];

  constructor(where: string, detail: string);
  constructor(mistakes: readonly OptionMistake[]);
  constructor(first: string | readonly OptionMistake[], detail = '') {
    const mistakes = typeof first === 'string' ? [{ where: first, detail }] : first;
    super(mistakes.map(sentence).join('\n'));
    this.mistakes = mistakes;
  }

  /** Place of the first mistake. */
  get where(): string {
    return this.mistakes[0]?.where ?? '';
  }
}

/** Throws all of them together, if there are any. @throws {OptionsError} */
export function throwMistakes(mistakes: readonly OptionMistake[]): void {
  if (mistakes.length > 0) throw new OptionsError(mistakes);
}

function sentence({ where, detail, found }: OptionMistake): string {
  return `${where} ${detail}${found === undefined ? '' : `, not ${found}`}`;
}
