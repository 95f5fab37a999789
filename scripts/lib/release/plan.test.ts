import { describe, expect, test } from 'vitest';
import { planRelease, ReleaseRefusal, type ReleaseRequest, type RepositoryState } from './plan.ts';

const FIXED = '## [Unreleased]\n\n### Fixed\n- One.\n';
const ADDED = '## [Unreleased]\n\n### Added\n- One.\n';
const BREAKING = '## [Unreleased]\n\n### Breaking changes\n- One.\n';
const RELEASED = '\n## [0.1.0] - 2026-01-31\n\n### Added\n- All.\n';

const state = (over: Partial<RepositoryState> = {}): RepositoryState => ({
  branch: 'main',
  changedFiles: [],
  tags: ['v0.1.0'],
  version: '0.1.0',
  changelog: FIXED + RELEASED,
  ...over,
});
const request = (version?: string): ReleaseRequest => ({ version, branch: 'main', date: '2026-02-28' });
const versionOf = (over: Partial<RepositoryState>, wanted?: string) =>
  planRelease(state(over), request(wanted)).version;

test('a plan has the version, the tag, the notes and the new changelog', () => {
  expect(planRelease(state(), request())).toEqual({
    version: '0.1.1',
    tag: 'v0.1.1',
    notes: '### Fixed\n- One.',
    changelog: `## [Unreleased]\n\n## [0.1.1] - 2026-02-28\n\n### Fixed\n- One.\n${RELEASED}`,
  });
});

describe('the version', () => {
  test('is the least that the changelog asks for', () => {
    expect(versionOf({ changelog: ADDED + RELEASED })).toBe('0.2.0');
    expect(versionOf({ changelog: BREAKING + RELEASED })).toBe('0.2.0');
    expect(versionOf({ changelog: BREAKING + RELEASED, version: '1.4.2' })).toBe('2.0.0');
  });

  test('may be higher, by name or by number', () => {
    expect(versionOf({}, 'minor')).toBe('0.2.0');
    expect(versionOf({}, 'major')).toBe('1.0.0');
    expect(versionOf({}, '0.1.7')).toBe('0.1.7');
  });

  test('of the first release is the one that the manifests have', () => {
    expect(versionOf({ changelog: ADDED, tags: [] })).toBe('0.1.0');
    expect(versionOf({ changelog: ADDED, tags: [] }, '0.1.0')).toBe('0.1.0');
    expect(versionOf({ changelog: ADDED, tags: [] }, '1.0.0')).toBe('1.0.0');
  });
});

describe('a release is refused', () => {
  test.each<[message: string, over: Partial<RepositoryState>, wanted?: string]>([
    ['releases are made from main, and this is topic: run git switch main first', { branch: 'topic' }],
    [
      'releases are made from main, and no branch is checked out: run git switch main first',
      { branch: null },
    ],
    ['the working tree has changes (README.md): commit or stash them first', { changedFiles: ['README.md'] }],
    [
      'the working tree has changes (README.md and 2 more): commit or stash them first',
      { changedFiles: ['README.md', 'a.ts', 'b.ts'] },
    ],
    [
      'CHANGELOG.md has no entry under [Unreleased]: there is nothing to release',
      { changelog: `## [Unreleased]\n${RELEASED}` },
    ],
    [
      'CHANGELOG.md:2: “### News” is none of ' +
        'Breaking changes, Added, Changed, Deprecated, Removed, Fixed, Security',
      { changelog: '## [Unreleased]\n### News\n' },
    ],
    ['“next” is no version: say major, minor, patch or one such as 1.2.3', {}, 'next'],
    ['package.json has the version “0.1”, which is none such as 1.2.3', { version: '0.1' }],
    [
      '0.1.1 is too low after 0.1.0: what CHANGELOG.md has under [Unreleased] asks for a minor release, 0.2.0',
      { changelog: ADDED + RELEASED },
      'patch',
    ],
    [
      '0.1.0 is too low after 0.1.0: what CHANGELOG.md has under [Unreleased] asks for a patch release, 0.1.1',
      {},
      '0.1.0',
    ],
    ['0.0.9 is too low: every package.json has 0.1.0 already', { changelog: ADDED, tags: [] }, '0.0.9'],
    ['the tag v0.1.1 is there already: choose a later version', { tags: ['v0.1.0', 'v0.1.1'] }],
  ])('%s', (message, over, wanted) => {
    expect(() => planRelease(state(over), request(wanted))).toThrow(new ReleaseRefusal(message));
  });
});
