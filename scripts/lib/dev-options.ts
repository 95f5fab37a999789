/** The options of `pnpm dev`. */
import { parseArgs } from 'node:util';
import { closest } from '@farpoint/service';

export const DEV_HELP = `pnpm dev [options]

  --port N     port of the web app; default: 5173 or the next free one
  --robots N   number of simulated robots, 1 to 16 (1)
  --lan        also serve the local network, by HTTPS and with pairing, for headsets and phones: docs/local-network.md
  --verbose    show the logs of every program

Signaling listens on 3000 (Farpoint), 3001 and 3002 (reference protocol); robots answer /healthz and /metrics from 9410
up. If another program uses one of these ports, the next free one is taken and reported. A program that ends is
restarted.
`;

const OPTIONS = {
  port: { type: 'string' },
  robots: { type: 'string', default: '1' },
  lan: { type: 'boolean', default: false },
  verbose: { type: 'boolean', default: false },
  help: { type: 'boolean', short: 'h', default: false },
} as const;
const NAMES = Object.keys(OPTIONS).map((name) => `--${name}`);

export interface DevOptions {
  /** `null`: any free port. */
  port: number | null;
  robots: number;
  lan: boolean;
  verbose: boolean;
}

/** A mistake on the command line: one sentence. */
export class DevOptionError extends Error {
  override readonly name = 'DevOptionError';
}

/**
 * @returns `null` if help was requested
 * @throws {DevOptionError}
 */
export function readDevOptions(argv: readonly string[]): DevOptions | null {
  const { values, tokens } = parseArgs({
    args: [...argv],
    options: OPTIONS,
    strict: false,
    tokens: true,
    allowPositionals: true,
  });
  for (const token of tokens) {
    if (token.kind === 'positional')
      throw new DevOptionError(`${JSON.stringify(token.value)} does not belong to an option; ${SEE_HELP}`);
    if (token.kind !== 'option') continue;
    if (!Object.hasOwn(OPTIONS, token.name))
      throw new DevOptionError(
        `${token.rawName} is not an option${closest(token.rawName, NAMES)}; ${SEE_HELP}`,
      );
    const takesValue = OPTIONS[token.name as keyof typeof OPTIONS].type === 'string';
    if (takesValue && token.value === undefined)
      throw new DevOptionError(`${token.rawName} needs a number after it; ${SEE_HELP}`);
    if (!takesValue && token.value !== undefined)
      throw new DevOptionError(`${token.rawName} takes no value, not ${JSON.stringify(token.value)}`);
  }
  if (values.help === true) return null;
  return {
    port: values.port === undefined ? null : readCount('--port', values.port, 65_535),
    robots: readCount('--robots', values.robots, 16),
    lan: values.lan === true,
    verbose: values.verbose === true,
  };
}

const SEE_HELP = '`pnpm dev --help` lists them';

function readCount(flag: string, given: unknown, most: number): number {
  const value = Number(given);
  if (Number.isInteger(value) && value >= 1 && value <= most) return value;
  throw new DevOptionError(`${flag} must be a whole number from 1 to ${most}, not ${JSON.stringify(given)}`);
}
