import type { Registry } from 'prom-client';
import {
  type AdminAddress,
  type AdminServer,
  createAdminHandler,
  createMetrics,
  startAdminServer,
} from './admin-server.ts';
import { Health } from './health.ts';
import { createLogger, type Logger } from './logger.ts';
import { OptionsError } from './option-errors.ts';
import { list, port, text } from './option-schemas.ts';
import {
  type CommonValues,
  defineOption,
  type OptionTable,
  type OptionValues,
  type ProgramDefinition,
} from './option-table.ts';
import { resolveOptions } from './options.ts';
import { withoutCredentials } from './secret.ts';
import { Shutdown } from './shutdown.ts';
import { startFailureOf } from './start-failure.ts';

/** What the framework provides to a running program. */
export interface ProgramContext<Table extends OptionTable> {
  readonly options: OptionValues<Table> & CommonValues;
  /** How messages name the source of an option's value. */
  readonly where: (key: keyof Table & string) => string;
  readonly log: Logger;
  readonly health: Health;
  readonly metrics: Registry;
  readonly shutdown: Shutdown;
  /** Serves `/healthz` and `/metrics` until shutdown, for programs without an HTTP server of their own. */
  serveAdmin(address: AdminAddress): Promise<AdminServer>;
}

/** The options of a program that calls `serveAdmin`. */
export function adminOptions(defaultPort: number) {
  return {
    adminHost: defineOption({
      schema: text(),
      default: '127.0.0.1',
      argument: 'ADDRESS',
      file: 'admin.host',
      help: 'address for /healthz and /metrics',
    }),
    adminPort: defineOption({
      schema: port(),
      default: defaultPort,
      argument: 'PORT',
      file: 'admin.port',
      help: 'port for /healthz and /metrics; 0 takes a free one',
    }),
    adminNames: defineOption({
      schema: list(text({ max: 253 })),
      default: [],
      argument: 'NAME,…',
      file: 'admin.names',
      help: 'other names under which this machine may be asked, e.g. robot.example; addresses, localhost and its own name always work',
    }),
  } satisfies OptionTable;
}

/**
 * Runs a program: reads its options, sets up log, health, metrics and shutdown, calls `main`, and lets it run until a
 * signal. Exit codes: 0 after an orderly end, 1 for a failure, 2 for a mistake in the options.
 *
 * `main` may also throw OptionsError, for mistakes that only show once files are read, and StartFailure for problems
 * that must be solved outside the program. It returns once the program is up; what keeps the program alive (servers,
 * timers) is closed through `shutdown.onClose`.
 */
export async function runProgram<const Table extends OptionTable>(
  definition: ProgramDefinition<Table>,
  main: (context: ProgramContext<Table>) => Promise<void>,
): Promise<void> {
  let resolved: ReturnType<typeof resolveOptions<Table>>;
  try {
    resolved = resolveOptions(definition, { argv: process.argv.slice(2), env: process.env });
  } catch (error) {
    if (!(error instanceof OptionsError)) throw error;
    process.stderr.write(mistakesText(definition.name, error));
    process.exitCode = 2;
    return;
  }
  if (resolved.action === 'print') {
    process.stdout.write(resolved.text);
    return;
  }
  const options = resolved.values;
  const log = createLogger({ name: definition.section, level: options.logLevel, format: options.logFormat });
  for (const name of resolved.unknownEnvironment) {
    log.warn({ variable: name }, 'environment variable is not an option of this program');
  }
  const health = new Health();
  const metrics = createMetrics();
  const shutdown = new Shutdown({ log });
  shutdown.signal.addEventListener('abort', () => health.stopping());
  shutdown.listen();
  const fail = (what: string) => (error: unknown) => {
    log.fatal({ err: error }, what);
    void shutdown.end(what, 1);
  };
  process.on('uncaughtException', fail('uncaught exception'));
  process.on('unhandledRejection', fail('unhandled rejection'));
  log.info({ version: definition.version, config: resolved.configPath, pid: process.pid }, 'starting');
  try {
    await main({
      options,
      where: resolved.where,
      log,
      health,
      metrics,
      shutdown,
      async serveAdmin(address) {
        const server = await startAdminServer(createAdminHandler(health, metrics), address);
        shutdown.onClose('admin server', () => server.close());
        log.info({ host: address.host, port: server.port }, 'health and metrics');
        return server;
      },
    });
  } catch (error) {
    const mistake = error instanceof OptionsError;
    const failure = startFailureOf(error, definition, options);
    if (mistake) process.stderr.write(mistakesText(definition.name, error));
    else if (failure !== null) log.fatal({ remedy: failure.remedy }, `could not start: ${failure.message}`);
    else log.fatal({ err: error }, 'could not start');
    await shutdown.end('could not start', mistake ? 2 : 1);
  }
}

/** For standard error: one sentence, or a list of them. */
export function mistakesText(program: string, { message, mistakes }: OptionsError): string {
  const shown = withoutCredentials(message);
  if (mistakes.length === 1) return `${program}: ${shown}\n`;
  const lines = shown.split('\n').map((line) => `  ${line}\n`);
  return `${program}: ${mistakes.length} mistakes in the options:\n${lines.join('')}`;
}
