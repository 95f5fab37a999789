/** One thing that is wrong with the options. */
export interface OptionMistake {
  /** As people read it: `--port`, `FARPOINT_SIGNALING_PORT` or `farpoint.yaml:3: signaling.port`. */
  readonly where: string;
  /** Completes the sentence that begins with `where`, e.g. `must be a whole number from 0 to 65535`. */
  readonly detail: string;
  /** Path of the configuration file, where it is one's mistake. */
  readonly file?: string;
  /** In that file, from 1. */
  readonly line?: number;
  /** Its place in the file (`signaling.port`), its flag or its variable. */
  readonly key?: string;
  /** As JSON, cut short; left out of secrets. */
  readonly found?: string;
}

/** Mistakes in flags, environment or configuration file: all that there are, each a sentence that names the place. Exit code 2. */
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

  /** Of the first mistake. */
  get where(): string {
    return this.mistakes[0]?.where ?? '';
  }
}

/** Throws all of them at once, if there are any. @throws {OptionsError} */
export function throwMistakes(mistakes: readonly OptionMistake[]): void {
  if (mistakes.length > 0) throw new OptionsError(mistakes);
}

function sentence({ where, detail, found }: OptionMistake): string {
  return `${where} ${detail}${found === undefined ? '' : `, not ${found}`}`;
}
