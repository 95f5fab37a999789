/** CHANGELOG.md: what is not released yet, and how a release is dated. Pure. */

/** Sections of a release, in their order (Keep a Changelog, with breaking changes apart and first). */
const CHANGE_KINDS = [
  'Breaking changes',
  'Added',
  'Changed',
  'Deprecated',
  'Removed',
  'Fixed',
  'Security',
] as const;
export type ChangeKind = (typeof CHANGE_KINDS)[number];

export interface Changelog {
  /** Sections under [Unreleased] that have entries, in their order. */
  unreleased: readonly ChangeKind[];
  /** Versions of the releases, newest first. */
  released: readonly string[];
}

/** What is wrong with the changelog, as one sentence with the line. */
export class ChangelogError extends Error {
  override readonly name = 'ChangelogError';

  constructor(line: number, what: string) {
    super(`CHANGELOG.md:${line}: ${what}`);
  }
}

const UNRELEASED = '## [Unreleased]';
const RELEASE = /^## \[(?<version>\d+\.\d+\.\d+)\] - \d{4}-\d{2}-\d{2}$/;

/** @throws {ChangelogError} where a heading is none of the form, or not in its place */
export function readChangelog(text: string): Changelog {
  const unreleased: ChangeKind[] = [];
  const released: string[] = [];
  let release: string | null = null;
  let kind: ChangeKind | null = null;
  text.split('\n').forEach((line, index) => {
    const fault = (what: string) => new ChangelogError(index + 1, what);
    if (line.startsWith('## ')) {
      const version = RELEASE.exec(line)?.groups?.version;
      if (release === null && line !== UNRELEASED) throw fault(`the first release must be “${UNRELEASED}”`);
      if (release !== null && version === undefined)
        throw fault(`“${line}” is not of the form “## [1.2.3] - 2026-01-31”`);
      if (version !== undefined) released.push(version);
      release = version ?? UNRELEASED;
      kind = null;
    } else if (line.startsWith('### ')) {
      const named = CHANGE_KINDS.find((each) => line === `### ${each}`);
      if (named === undefined) throw fault(`“${line}” is none of ${CHANGE_KINDS.join(', ')}`);
      if (kind !== null && CHANGE_KINDS.indexOf(named) <= CHANGE_KINDS.indexOf(kind))
        throw fault(`“${named}” must come before “${kind}”, and once in a release`);
      kind = named;
    } else if (release === UNRELEASED && line.startsWith('- ')) {
      if (kind === null) throw fault('an entry must stand under a heading such as “### Added”');
      if (unreleased.at(-1) !== kind) unreleased.push(kind);
    }
  });
  if (release === null) throw new ChangelogError(1, `there is no heading “${UNRELEASED}”`);
  return { unreleased, released };
}

/**
 * What stands under [Unreleased], without that heading. Headings without entries are left out.
 *
 * @throws {ChangelogError} as {@link readChangelog} does
 */
export function unreleasedNotes(text: string): string {
  readChangelog(text);
  const { notes } = parts(text);
  return notes
    .split(/^(?=### )/m)
    .filter((section) => /^- /m.test(section))
    .map((section) => section.trim())
    .join('\n\n');
}

/**
 * The changelog with what was not released yet under the version and its date, and an empty [Unreleased] above.
 *
 * @param date ISO 8601, e.g. `2026-01-31`
 * @throws {ChangelogError} as {@link readChangelog} does
 */
export function releaseChangelog(text: string, version: string, date: string): string {
  const notes = unreleasedNotes(text);
  const { before, after } = parts(text);
  return `${before}${UNRELEASED}\n\n## [${version}] - ${date}\n\n${notes}\n${after === '' ? '' : `\n${after}`}`;
}

/** Before the heading of what is not released, between it and the next release, and from there on. */
function parts(text: string): { before: string; notes: string; after: string } {
  const start = text.indexOf(UNRELEASED);
  const end = text.indexOf('\n## ', start);
  return {
    before: text.slice(0, start),
    notes: text.slice(start + UNRELEASED.length, end < 0 ? undefined : end),
    after: end < 0 ? '' : text.slice(end + 1),
  };
}
