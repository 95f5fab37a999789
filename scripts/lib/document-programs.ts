/** The commands in README and documents, how each is tested, and the programs that they start. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { TREATMENTS, type Treatment } from './document-command-table.ts';
import { type DocumentCommand, documentCommands, shellWords } from './document-commands.ts';
import { root } from './run.ts';

const FILES = [
  'README.md',
  'CONTRIBUTING.md',
  'examples/README.md',
  ...readdirSync(join(root, 'docs'))
    .filter((name) => name.endsWith('.md'))
    .map((name) => `docs/${name}`),
];

/** Text of a file of the repository. */
export const read = (file: string): string => readFileSync(join(root, file), 'utf8');

/** The root's scripts. */
export const { scripts } = JSON.parse(read('package.json')) as { scripts: Record<string, string> };

/** All of them, with the file that each is in. */
export const found: readonly ({ file: string } & DocumentCommand)[] = FILES.flatMap((file) =>
  documentCommands(read(file)).map((each) => ({ file, ...each })),
);
export const texts: readonly string[] = [...new Set(found.map(({ text }) => text))];

/** Those that are in the table. */
export const known: readonly { text: string; treatment: Treatment }[] = texts.flatMap((text) => {
  const treatment = TREATMENTS[text];
  return treatment === undefined ? [] : [{ text, treatment }];
});

export interface Program {
  /** Path within the repository. */
  file: string;
  args: string[];
}

/** The script of `pnpm <script>` or `pnpm run <script>`, however pnpm is called. */
export function scriptOf(words: readonly string[]): { name: string; args: string[] } | null {
  const at = words.findIndex((word) => /^pnpm(@\d+)?$/.test(word));
  const [name, ...args] = at < 0 ? [] : words.slice(words[at + 1] === 'run' ? at + 2 : at + 1);
  return name === undefined || /^(-|exec$|@)/.test(name) ? null : { name, args };
}

/** @throws {Error} if the command starts a script that is not one of Node's */
export function programOf(words: readonly string[]): Program {
  const script = scriptOf(words);
  if (script !== null) {
    const [node, file = '', ...first] = shellWords(scripts[script.name] ?? '');
    if (node !== 'node') throw new Error(`${script.name} is not a program of Node`);
    return { file, args: [...first, ...script.args] };
  }
  const robot = words.indexOf('farpoint-robot');
  if (robot >= 0) return { file: 'apps/robot-node/src/main.ts', args: words.slice(robot + 1) };
  const signaling = words.indexOf('signaling.mjs');
  return { file: 'apps/signaling/src/main.ts', args: words.slice(signaling + 1) };
}

/** The module of a benchmark that a command runs; `null` if it runs none. */
export function benchOf({ file, args }: Program): string | null {
  const [name = ''] = args;
  return file === 'bench/main.ts' && /^[a-z]/.test(name) ? `bench/src/${name}.ts` : null;
}

/** The options that a command gives to its program. */
export function optionsIn(args: readonly string[]): string[] {
  const end = args.indexOf('--');
  return args
    .slice(0, end < 0 ? args.length : end)
    .filter((word) => /^--?[a-z]/.test(word) && word !== '--help');
}

/** Whether a help text or a program contains this option as a separate word. */
export function names(source: string, option: string): boolean {
  const escaped = option.replaceAll(/[.*+?^${}()|[\]\\]/g, '\\$&');
  const spelled = new RegExp(`(?<![\\w-])${escaped}(?![\\w-])`);
  // Programs that use parseArgs contain the bare name.
  return spelled.test(source) || new RegExp(`^\\s*'?${escaped.replace(/^--/, '')}'?: \\{`, 'm').test(source);
}
