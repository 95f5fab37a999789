/** What a release will be, or why there can be none. Pure: the repository's state is an argument. */
import { ChangelogError, readChangelog, releaseChangelog, unreleasedNotes } from './changelog.ts';
import {
  compareVersions,
  formatVersion,
  leastStep,
  nextVersion,
  parseVersion,
  STEPS,
  type Step,
  type Version,
} from './version.ts';

export interface RepositoryState {
  /** `null` where HEAD is detached. */
  branch: string | null;
  /** Files that differ from the last commit, untracked ones included. */
  changedFiles: readonly string[];
  tags: readonly string[];
  /** Of every package.json. */
  version: string;
  /** Text of CHANGELOG.md. */
  changelog: string;
}

export interface ReleaseRequest {
  /** `major`, `minor`, `patch` or a version; where left out, the least that the changelog asks for. */
  version?: string | undefined;
  /** The branch that releases are made from. */
  branch: string;
  /** ISO 8601, e.g. `2026-01-31`. */
  date: string;
}

export interface ReleasePlan {
  version: string;
  tag: string;
  /** What the changelog says of the release. */
  notes: string;
  /** The changelog's new text. */
  changelog: string;
}

/** Why there can be no release: one sentence, with what to do. */
export class ReleaseRefusal extends Error {
  override readonly name = 'ReleaseRefusal';
}

/** @throws {ReleaseRefusal} where something is wrong */
export function planRelease(state: RepositoryState, request: ReleaseRequest): ReleasePlan {
  refuseWrongPlace(state, request.branch);
  try {
    const version = formatVersion(chooseVersion(state, request.version));
    const tag = `v${version}`;
    if (state.tags.includes(tag))
      throw new ReleaseRefusal(`the tag ${tag} is there already: choose a later version`);
    return {
      version,
      tag,
      notes: unreleasedNotes(state.changelog),
      changelog: releaseChangelog(state.changelog, version, request.date),
    };
  } catch (error) {
    throw error instanceof ChangelogError ? new ReleaseRefusal(error.message) : error;
  }
}

function refuseWrongPlace({ branch, changedFiles }: RepositoryState, wanted: string): void {
  if (branch !== wanted) {
    const place = branch === null ? 'no branch is checked out' : `this is ${branch}`;
    throw new ReleaseRefusal(
      `releases are made from ${wanted}, and ${place}: run git switch ${wanted} first`,
    );
  }
  const [first, ...others] = changedFiles;
  if (first !== undefined) {
    const more = others.length === 0 ? '' : ` and ${others.length} more`;
    throw new ReleaseRefusal(`the working tree has changes (${first}${more}): commit or stash them first`);
  }
}

function chooseVersion(state: RepositoryState, wanted: string | undefined): Version {
  const { unreleased, released } = readChangelog(state.changelog);
  if (unreleased.length === 0)
    throw new ReleaseRefusal('CHANGELOG.md has no entry under [Unreleased]: there is nothing to release');
  const present = parseVersion(state.version);
  if (present === null)
    throw new ReleaseRefusal(`package.json has the version “${state.version}”, which is none such as 1.2.3`);
  const version = wanted === undefined ? null : wantedVersion(wanted, present);
  // The version that the manifests have from the start is free until the first release.
  if (released.length === 0) {
    if (version !== null && compareVersions(version, present) < 0)
      throw new ReleaseRefusal(`${wanted} is too low: every package.json has ${state.version} already`);
    return version ?? present;
  }
  const step = leastStep(unreleased, present);
  const least = nextVersion(present, step);
  if (version !== null && compareVersions(version, least) < 0)
    throw new ReleaseRefusal(
      `${formatVersion(version)} is too low after ${state.version}: what CHANGELOG.md has under [Unreleased] asks for a ` +
        `${step} release, ${formatVersion(least)}`,
    );
  return version ?? least;
}

function wantedVersion(wanted: string, present: Version): Version {
  if (isStep(wanted)) return nextVersion(present, wanted);
  const version = parseVersion(wanted);
  if (version === null)
    throw new ReleaseRefusal(`“${wanted}” is no version: say major, minor, patch or one such as 1.2.3`);
  return version;
}

function isStep(text: string): text is Step {
  return (STEPS as readonly string[]).includes(text);
}
