/** The options of `pnpm test` for measuring how often tests fail without a fault. Pure. */

/** Beside what tests run, and on what. */
export interface RepeatOptions {
  /** How often the chosen steps run. */
  repeat: number;
  /** Programs that keep a core busy each, at the tests' own priority. */
  load: number;
  /** Cores that tests and busy programs share; `null`: all. */
  cpus: number | null;
}

const MOST = { repeat: 1000, load: 64, cpus: 1024 } as const;

/**
 * @param values as given on the command line @param cores of this machine @param platform as Node names it
 * @throws {Error} that says which option is wrong, and what it may be
 */
export function readRepeatOptions(
  values: { repeat?: string | undefined; load?: string | undefined; cpus?: string | undefined },
  cores: number,
  platform: string = process.platform,
): RepeatOptions {
  const number = (name: keyof typeof MOST, least: number, most: number, text: string): number => {
    const value = Number(text);
    if (!/^\d+$/.test(text) || value < least || value > most)
      throw new Error(`--${name}: a whole number from ${least} to ${most} is needed, not ${text}`);
    return value;
  };
  const { repeat, load, cpus } = values;
  if (cpus !== undefined && platform !== 'linux')
    throw new Error('--cpus: only Linux keeps programs to some of its cores');
  return {
    repeat: repeat === undefined ? 1 : number('repeat', 1, MOST.repeat, repeat),
    load: load === undefined ? 0 : number('load', 0, MOST.load, load),
    cpus: cpus === undefined ? null : number('cpus', 1, Math.min(cores, MOST.cpus), cpus),
  };
}
