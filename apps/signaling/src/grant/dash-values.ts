/**
 * Thumbprints and ids are base64url: one in 64 begins with a dash, and looks like an option to a parser of arguments. Pure.
 */

/** Of `parseArgs`: which options there are, and which take a value. */
type Options = Readonly<Record<string, { readonly type: 'string' | 'boolean' }>>;

/**
 * Ties a value that begins with a dash to its option (`--for -x` becomes `--for=-x`), unless it is itself one of the
 * options: then the value was forgotten, which the parser says.
 */
export function tieDashValues(argv: readonly string[], options: Options): string[] {
  const isOption = (argument: string): boolean =>
    argument === '--' ||
    Object.keys(options).some((name) => argument === `--${name}` || argument.startsWith(`--${name}=`));
  const tied: string[] = [];
  for (let i = 0; i < argv.length; i++) {
    const [argument, value] = [argv[i] as string, argv[i + 1]];
    const takesValue = argument.startsWith('--') && options[argument.slice(2)]?.type === 'string';
    if (takesValue && value?.startsWith('-') === true && value !== '-' && !isOption(value)) {
      tied.push(`${argument}=${value}`);
      i++;
    } else tied.push(argument);
  }
  return tied;
}
