/** Tests every command in README and documents: each runs if it can, and its options are the program's own. */
import { spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { afterAll, describe, expect, test } from 'vitest';
import { TREATMENTS, type Treatment } from './lib/document-command-table.ts';
import { documentCommands, shellWords } from './lib/document-commands.ts';
import { root } from './lib/run.ts';

const FILES = [
  ...['README.md', 'CONTRIBUTING.md', 'examples/README.md'],
  ...readdirSync(join(root, 'docs'))
    .filter((name) => name.endsWith('.md'))
    .map((name) => `docs/${name}`),
];
const read = (file: string) => readFileSync(join(root, file), 'utf8');
const { scripts } = JSON.parse(read('package.json')) as { scripts: Record<string, string> };
const found = FILES.flatMap((file) => documentCommands(read(file)).map((each) => ({ file, ...each })));
const texts = [...new Set(found.map(({ text }) => text))];
const folder = mkdtempSync(join(tmpdir(), 'farpoint-documents-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

test('each command is in the table, and each in the table is in a document', () => {
  const unknown = found.filter(({ text }) => TREATMENTS[text] === undefined);
  expect(unknown.map(({ file, line, text }) => `${file}:${line}: ${text}`)).toEqual([]);
  expect(Object.keys(TREATMENTS).filter((text) => !texts.includes(text))).toEqual([]);
});

test('programs are started through their scripts, so that Node 18 or newer is enough', () => {
  const direct = found.filter(({ text }) => /\bnode (apps|packages|scripts|bench)\/\S+\.ts/.test(text));
  const allowed = direct.filter(({ text }) => text.includes('pnpm@12 exec node '));
  expect(direct.map(({ text }) => text)).toEqual(allowed.map(({ text }) => text));
});

const known = texts.flatMap((text) => {
  const treatment = TREATMENTS[text];
  return treatment === undefined ? [] : [{ text, treatment }];
});

describe('files and scripts that commands name exist', () => {
  test.each(known)('$text', ({ text }) => {
    const words = shellWords(text);
    for (const word of words) {
      if (/^(apps|docs|examples|packages|scripts|wasm-codec)\/\S+$/.test(word) && !word.includes('/dist'))
        expect(existsSync(join(root, word)), word).toBe(true);
    }
    const script = scriptOf(words);
    if (script !== null) expect(Object.keys(scripts)).toContain(script.name);
  });
});

describe('a command’s options are the program’s', () => {
  const helps = new Map<string, string>();
  test.each(known.filter(({ treatment }) => 'help' in treatment || 'options' in treatment))(
    '$text',
    ({ text, treatment }) => {
      const words = shellWords(text);
      const [own, source] =
        'options' in treatment
          ? [words.slice(words.indexOf(treatment.options) + 1), read(treatment.options)]
          : [programOf(words).args, helpOf(programOf(words))];
      const end = own.indexOf('--');
      const options = own
        .slice(0, end < 0 ? own.length : end)
        .filter((word) => /^--?[a-z]/.test(word) && word !== '--help');
      for (const option of options) expect(names(source, option), `${option} in\n${source}`).toBe(true);
    },
    30_000,
  );

  function helpOf({ file, args }: Program): string {
    // For a benchmark, a suite or a command of the robot, use the help of that.
    const sub = /^[a-z]/.test(args[0] ?? '') ? args.slice(0, 1) : [];
    const key = [file, ...sub].join(' ');
    const cached = helps.get(key);
    if (cached !== undefined) return cached;
    const { status, stdout } = spawnSync(process.execPath, [join(root, file), ...sub, '--help'], {
      ...{ cwd: folder, encoding: 'utf8' },
    });
    expect(status, key).toBe(0);
    // The robot's doctor accepts the robot's options, too.
    const rest = /any option of farpoint-robot/.test(stdout) ? helpOf({ file, args: [] }) : '';
    helps.set(key, stdout + rest);
    return stdout + rest;
  }
});

describe('a command runs', () => {
  test.each(known.filter(({ treatment }) => 'up' in treatment || 'refused' in treatment))(
    '$text',
    async ({ text, treatment }) => {
      const { said, code } = await runs(programOf(shellWords(text)), treatment as Running);
      const wanted = 'up' in treatment ? treatment.up : (treatment as { refused: RegExp }).refused;
      expect(said.join('\n')).toMatch(typeof wanted === 'string' ? wanted : new RegExp(wanted, 'm'));
      if ('up' in treatment) expect(code, said.join('\n')).toBe(0);
      else expect(code).not.toBe(0);
    },
    30_000,
  );
});

interface Program {
  /** Path within the repository. */
  file: string;
  args: string[];
}

type Running = Extract<Treatment, { up: unknown }> | Extract<Treatment, { refused: unknown }>;

/** The script of `pnpm <script>` or `pnpm run <script>`, however pnpm is called. */
function scriptOf(words: readonly string[]): { name: string; args: string[] } | null {
  const at = words.findIndex((word) => /^pnpm(@\d+)?$/.test(word));
  const [name, ...args] = at < 0 ? [] : words.slice(words[at + 1] === 'run' ? at + 2 : at + 1);
  return name === undefined || /^(-|exec$|@)/.test(name) ? null : { name, args };
}

function programOf(words: readonly string[]): Program {
  const script = scriptOf(words);
  if (script !== null) {
    const [node, file = '', ...first] = shellWords(scripts[script.name] ?? '');
    expect(node, script.name).toBe('node');
    return { file, args: [...first, ...script.args] };
  }
  const robot = words.indexOf('farpoint-robot');
  if (robot >= 0) return { file: 'apps/robot-node/src/main.ts', args: words.slice(robot + 1) };
  const signaling = words.indexOf('signaling.mjs');
  return { file: 'apps/signaling/src/main.ts', args: words.slice(signaling + 1) };
}

/** The document's own words come first: if an option is given twice, the last one counts. */
async function runs({ file, args }: Program, treatment: Running): Promise<{ said: string[]; code: unknown }> {
  const fill = 'fill' in treatment ? treatment.fill : undefined;
  // Dots at the end stand for additions by the reader; dots after an option stand for its value.
  const own = args.at(-1) === '…' && !/^--token$/.test(args.at(-2) ?? '') ? args.slice(0, -1) : args;
  const words = own.map((word) => fill?.[word] ?? word);
  const child = spawn(process.execPath, [join(root, file), ...words, ...(treatment.also ?? [])], {
    cwd: folder,
    // A folder of its own, away from the robot state of the person who runs the tests.
    env: { ...process.env, XDG_STATE_HOME: folder },
    stdio: ['ignore', 'pipe', 'pipe'],
  });
  const exited = new Promise((resolve) => child.once('exit', resolve));
  const said: string[] = [];
  const errors = createInterface({ input: child.stderr }).on('line', (line) => said.push(line));
  for await (const line of createInterface({ input: child.stdout })) {
    const { msg } = JSON.parse(line) as { msg: string };
    said.push(msg);
    if ('up' in treatment && msg.match(treatment.up) !== null) child.kill('SIGTERM');
  }
  const code = await exited;
  errors.close();
  return { said, code };
}

/** Whether a help text or a program contains this option as a separate word. */
function names(source: string, option: string): boolean {
  const escaped = option.replaceAll(/[.*+?^${}()|[\]\\]/g, '\\$&');
  const spelled = new RegExp(`(?<![\\w-])${escaped}(?![\\w-])`);
  // Programs that use parseArgs contain the bare name.
  return spelled.test(source) || new RegExp(`^\\s*'?${escaped.replace(/^--/, '')}'?: \\{`, 'm').test(source);
}
