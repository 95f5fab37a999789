/**
 * `pnpm bench <name> [options]`: runs one benchmark. Each is a module `bench/src/<name>.ts` that exports `bench`, and
 * is loaded only on demand.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { asksForHelp } from './src/bench-options.ts';
import type { Bench } from './src/report.ts';

const FOLDER = join(import.meta.dirname, 'src');

/** The names of the benchmarks, which are the modules that export one. Loads nothing. */
function benchNames(): string[] {
  return readdirSync(FOLDER)
    .filter((file) => file.endsWith('.ts') && !file.endsWith('.test.ts'))
    .filter((file) => /^export const bench\b/m.test(readFileSync(join(FOLDER, file), 'utf8')))
    .map((file) => file.slice(0, -'.ts'.length))
    .sort();
}

async function load(name: string): Promise<Bench> {
  const module = (await import(pathToFileURL(join(FOLDER, `${name}.ts`)).href)) as { bench: Bench };
  return module.bench;
}

async function usage(names: readonly string[]): Promise<string> {
  const lines = ['pnpm bench <name> [options]', ''];
  for (const name of names) {
    const summary = await load(name).then(
      (bench) => bench.summary,
      (error: unknown) => `(cannot be loaded: ${error instanceof Error ? error.message : String(error)})`,
    );
    lines.push(`  ${name.padEnd(12)} ${summary}`);
  }
  lines.push('', 'Every benchmark takes --json (one JSON object as the last line of output) and --help.');
  return lines.join('\n');
}

async function main(): Promise<number> {
  const [name, ...argv] = process.argv.slice(2);
  const names = benchNames();
  if (name === undefined || name === '--help' || name === '-h') {
    console.log(await usage(names));
    return name === undefined ? 2 : 0;
  }
  if (!names.includes(name)) {
    console.error(`bench: there is no benchmark \`${name}\`; the benchmarks are ${names.join(', ')}`);
    return 2;
  }
  try {
    const bench = await load(name);
    if (asksForHelp(argv)) console.log(bench.usage);
    else await bench.run(argv);
    return 0;
  } catch (error) {
    console.error(`bench ${name}: ${error instanceof Error ? error.message : String(error)}`);
    return 1;
  }
}

const code = await main();
if (code !== 0) process.exitCode = code;
