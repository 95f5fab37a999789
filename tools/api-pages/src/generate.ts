/** The published packages' API pages in Markdown, from their docstrings. */
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { Application, Logger, LogLevel, TSConfigReader, type TypeDocOptions } from 'typedoc';
import { load as markdown, type PluginOptions } from 'typedoc-plugin-markdown';
import { showDetails } from './visible-details.ts';

const root = resolve(import.meta.dirname, '../../..');

/** What pages are made from. */
export interface ApiSources {
  /** Modules whose exports have pages, one page each. */
  entryPoints: readonly string[];
  /** By which all of them compile. */
  tsconfig: string;
}

/** The published packages. */
const PUBLISHED: ApiSources = {
  entryPoints: ['operator', 'cloud-view'].map((name) => join(root, 'packages', name, 'src/index.ts')),
  // Without project references, through which TypeDoc would see declarations instead of sources.
  tsconfig: join(root, 'tools/api-pages/pages.tsconfig.json'),
};
/** Whose symbols need docstrings: the published packages, and the one whose types are among their exports. */
const DOCUMENTED = ['@farpoint/operator', '@farpoint/cloud-view', '@farpoint/protocol'];

const NOTICE = '<!-- Written by `pnpm docs:api`. Edit the docstrings instead. -->\n\n';

/** Pages by file name. */
export type Pages = ReadonlyMap<string, string>;

/** Thrown where the pages would be incomplete. */
export class ApiPagesError extends Error {
  override readonly name = 'ApiPagesError';
  /** What is missing, one sentence each. */
  readonly faults: readonly string[];

  constructor(faults: readonly string[]) {
    super(`the API pages are incomplete:\n${faults.join('\n')}`);
    this.faults = faults;
  }
}

/**
 * Makes the pages.
 *
 * @throws {ApiPagesError} where an exported symbol has no docstring, a docstring's link leads nowhere, or the sources do not
 *   compile
 */
export async function apiPages(sources = PUBLISHED): Promise<Pages> {
  // TypeDoc empties the folder that it writes into: it gets one of its own.
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-api-'));
  try {
    const app = await Application.bootstrapWithPlugins(options(sources, folder), [new TSConfigReader()]);
    const logger = new FaultLogger();
    app.logger = logger;
    showDetails(app);
    const project = await app.convert();
    if (project === undefined) throw new ApiPagesError(logger.faults);
    app.validate(project);
    await app.generateOutputs(project);
    if (logger.faults.length > 0) throw new ApiPagesError(logger.faults);
    const files = readdirSync(folder).filter((file) => file.endsWith('.md'));
    return new Map(files.sort().map((file) => [file, NOTICE + readFileSync(join(folder, file), 'utf8')]));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function options(
  { entryPoints, tsconfig }: ApiSources,
  folder: string,
): TypeDocOptions & Partial<PluginOptions> {
  return {
    name: 'Farpoint API',
    entryPoints: [...entryPoints],
    tsconfig,
    plugin: [markdown],
    outputs: [{ name: 'markdown', path: folder }],
    logLevel: LogLevel.Warn,
    readme: 'none',
    router: 'module',
    // Lines move with every edit; a page changes only where the interface does.
    disableSources: true,
    excludeExternals: true,
    excludePrivate: true,
    preservedTypeAnnotationTags: ['@throws'],
    validation: { notDocumented: true, notExported: true, invalidLink: true },
    packagesRequiringDocumentation: DOCUMENTED,
    pageTitleTemplates: { index: 'Farpoint API', module: ({ name }) => `@farpoint/${name}` },
    hidePageHeader: true,
    hideBreadcrumbs: true,
    useCodeBlocks: true,
    parametersFormat: 'table',
    interfacePropertiesFormat: 'table',
    typeDeclarationFormat: 'table',
  };
}

/** A message's `type` is its name: a docstring would only repeat it. */
const SPEAKS_FOR_ITSELF = /\.type \(Property\), .* does not have any documentation/;

/** Keeps warnings and errors instead of printing them. */
class FaultLogger extends Logger {
  readonly faults: string[] = [];

  override log(message: string, level: LogLevel): void {
    const isFault = level === LogLevel.Warn || level === LogLevel.Error;
    if (isFault && !SPEAKS_FOR_ITSELF.test(message)) this.faults.push(message);
  }
}
