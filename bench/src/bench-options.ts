/**
 * The options of a benchmark. A table names each once, in camelCase, with its default and what it may be; `rateMbps` is
 * `--rate-mbps` on the command line. Every benchmark also has `--json` and `--help`.
 */
import { parseArgs } from 'node:util';

interface Option<T> {
  /** How it stands on the command line: alone, before each of its values, or as values without a name. */
  form: 'flag' | 'value' | 'values' | 'bare';
  default: T;
  /** The end of the sentence that refuses a value. */
  allowed: string;
  /** @returns `undefined` if the value is not allowed */
  read(text: string): T | undefined;
}

type OptionTable = Record<string, Option<unknown>>;

/** What {@link benchOptions} reads by a table. */
export type OptionValues<Table extends OptionTable> = {
  [Key in keyof Table]: Table[Key] extends Option<infer T> ? T : never;
} & { json: boolean };

interface Limits {
  /** 0, if it is not given. */
  least?: number;
  most?: number;
  whole?: boolean;
}

/** The kinds of options. A default `undefined` says that the option may be absent. */
export const option = {
  /** A value that a benchmark reads in its own way. */
  of<T, Default>(
    value: Default,
    allowed: string,
    read: (text: string) => T | undefined,
  ): Option<T | Default> {
    return { form: 'value', default: value, allowed, read };
  },

  text<Default extends string | undefined = undefined>(value?: Default): Option<string | Default> {
    return option.of(value as Default, 'a text', (text) => text);
  },

  number<Default extends number | undefined>(
    value: Default,
    { least = 0, most = Infinity, whole = false }: Limits = {},
  ): Option<number | Default> {
    const range = most === Infinity ? `of at least ${least}` : `from ${least} to ${most}`;
    return option.of(value, `a ${whole ? 'whole ' : ''}number ${range}`, (text) => {
      const number = text.trim() === '' ? Number.NaN : Number(text);
      const isAllowed = Number.isFinite(number) && number >= least && number <= most;
      return isAllowed && (!whole || Number.isInteger(number)) ? number : undefined;
    });
  },

  choice<const Name extends string, Default extends Name | undefined>(
    value: Default,
    names: readonly Name[],
  ): Option<Name | Default> {
    return option.of(value, `one of ${names.join(', ')}`, (text) => names.find((name) => name === text));
  },

  /** Values of an option with commas between them. */
  list<T>(values: Exclude<T, undefined>[], { allowed, read }: Option<T>): Option<Exclude<T, undefined>[]> {
    return option.of(values, `${allowed}, or several with commas between them`, (text) => {
      const all = text.split(',').map(read);
      return all.includes(undefined) ? undefined : (all as Exclude<T, undefined>[]);
    });
  },

  flag: unread<boolean>('flag', false),
  /** The texts of an option that may be given several times. */
  repeated: unread<string[]>('values', []),
  /** The arguments that no option takes. */
  bare: unread<string[]>('bare', []),
};

/** An option that takes every text, or none. */
function unread<T>(form: Option<T>['form'], value: T): Option<T> {
  return { form, default: value, allowed: '', read: () => undefined };
}

export function asksForHelp(argv: readonly string[]): boolean {
  const end = argv.indexOf('--');
  return argv.slice(0, end < 0 ? argv.length : end).includes('--help');
}

/** @throws {Error} naming the option, what was given, and what is allowed */
export function benchOptions<Table extends OptionTable>(argv: string[], table: Table): OptionValues<Table> {
  const rows = Object.entries<Option<unknown>>({ ...table, json: option.flag }).map(([key, row]) => {
    return { key, name: key.replaceAll(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`), ...row };
  });
  const { values, positionals } = parse(argv, rows);
  const read = ({ name, form, allowed, ...row }: (typeof rows)[number]) => {
    const given = form === 'bare' ? positionals : values[name];
    if (typeof given !== 'string') return given ?? row.default;
    const value = row.read(given);
    if (value === undefined) throw new Error(`--${name} is \`${given}\`, not ${allowed}`);
    return value;
  };
  return Object.fromEntries(rows.map((row) => [row.key, read(row)])) as OptionValues<Table>;
}

function parse(args: string[], rows: readonly { name: string; form: Option<unknown>['form'] }[]) {
  const named = rows.filter(({ form }) => form !== 'bare');
  const options = Object.fromEntries(
    named.map(({ name, form }) => [
      name,
      { type: form === 'flag' ? ('boolean' as const) : ('string' as const), multiple: form === 'values' },
    ]),
  );
  try {
    return parseArgs({ args, options, allowPositionals: named.length < rows.length });
  } catch (error) {
    // Node's advice about arguments that begin with a dash helps nobody here.
    const [sentence] = (error as Error).message.split('. To specify');
    throw new Error(
      `${sentence}; the options are ${named.map(({ name }) => `--${name}`).join(', ')}, --help`,
    );
  }
}
