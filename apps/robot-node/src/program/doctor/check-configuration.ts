/** Checks the configuration: names every mistake, and says where the values come from. */
import { statSync } from 'node:fs';
import { OptionsError, type ResolvedOptions, resolveOptions } from '@farpoint/service';
import { toRobotOptions } from '../options/robot-options.ts';
import { type RobotOptionValues, robotProgram } from '../options/robot-program.ts';
import type { RobotOptions } from '../robot-configuration.ts';
import { fail, ok, type Result, warn } from './finding.ts';

export interface Configuration {
  results: Result[];
  /** `null` if the configuration has a mistake. */
  values: RobotOptionValues | null;
  robot: RobotOptions | null;
}

export function checkConfiguration(
  argv: readonly string[],
  env: Readonly<Record<string, string | undefined>>,
): Configuration {
  try {
    const resolved = resolveOptions(robotProgram, { argv, env });
    if (resolved.action === 'print') throw new Error('only options of the robot are checked');
    const robot = toRobotOptions(resolved.values, resolved.where);
    return { results: describe(resolved), values: resolved.values, robot };
  } catch (error) {
    if (!(error instanceof OptionsError)) throw error;
    const results = error.mistakes.map(({ where, detail, found }) =>
      fail(
        `${where} ${detail}${found === undefined ? '' : `, not ${found}`}`,
        'correct it; `farpoint-robot --help all` lists every option',
      ),
    );
    return { results, values: null, robot: null };
  }
}

type Resolved = Extract<ResolvedOptions<typeof robotProgram.options>, { action: 'run' }>;

function describe({ configPath, sources, values, unknownEnvironment }: Resolved): Result[] {
  const count = (source: string) => Object.values(sources).filter((from) => from === source).length;
  const file = configPath === null ? 'no file' : `${count('config')} options from ${configPath}`;
  const what = `${file}, ${count('environment')} from the environment, ${count('flag')} from the command line`;
  const results = [ok(what)];
  for (const name of unknownEnvironment)
    results.push(
      warn(`the variable ${name} is not an option`, 'see `farpoint-robot --help all` for the correct name'),
    );
  const secret = sources.token === 'config' || sources.key === 'config' || sources.iceServers === 'config';
  if (configPath !== null && secret && values.token !== null && isPublic(configPath))
    results.push(
      warn(`${configPath} contains secrets and everybody may read it`, `\`chmod o-r ${configPath}\``),
    );
  return results;
}

function isPublic(path: string): boolean {
  return ((statSync(path, { throwIfNoEntry: false })?.mode ?? 0) & 0o004) !== 0;
}
