import { describe, expect, test } from 'vitest';
import { readWorkspaceFile } from '../workspace-files.ts';
import { readChangelog, releaseChangelog, unreleasedNotes } from './changelog.ts';

const HEAD = '# Changelog\n\nAbout it.\n\n';
const UNRELEASED = `## [Unreleased]

### Breaking changes
- One thing,
  in two lines.

### Added

### Fixed
- Another.
`;
const RELEASED = '## [0.1.0] - 2026-01-31\n\n### Added\n- All of it.\n';

test('the project’s own changelog can be released', () => {
  const text = readWorkspaceFile('CHANGELOG.md');
  const { unreleased, released } = readChangelog(text);
  expect(unreleased.length + released.length).toBeGreaterThan(0);
  const after = readChangelog(releaseChangelog(text, '99.0.0', '2026-01-31'));
  expect(after).toEqual({ unreleased: [], released: ['99.0.0', ...released] });
});

test('a release takes the entries over, dated, and leaves the rest as it is', () => {
  expect(releaseChangelog(`${HEAD}${UNRELEASED}\n${RELEASED}`, '0.2.0', '2026-02-28')).toBe(
    `${HEAD}## [Unreleased]

## [0.2.0] - 2026-02-28

### Breaking changes
- One thing,
  in two lines.

### Fixed
- Another.

${RELEASED}`,
  );
});

test('the first release has nothing below it', () => {
  const text = releaseChangelog(HEAD + UNRELEASED, '0.1.0', '2026-01-31');
  expect(text.endsWith('- Another.\n')).toBe(true);
  expect(readChangelog(text)).toEqual({ unreleased: [], released: ['0.1.0'] });
});

test('notes are the sections with entries', () => {
  expect(unreleasedNotes(`${HEAD}${UNRELEASED}\n${RELEASED}`)).toBe(
    '### Breaking changes\n- One thing,\n  in two lines.\n\n### Fixed\n- Another.',
  );
  expect(unreleasedNotes(`${HEAD}## [Unreleased]\n\n${RELEASED}`)).toBe('');
});

test('kinds of changes are those with entries', () => {
  expect(readChangelog(HEAD + UNRELEASED).unreleased).toEqual(['Breaking changes', 'Fixed']);
});

describe('a changelog of another form is refused with its line', () => {
  test.each([
    ['# Changelog\n', 'CHANGELOG.md:1: there is no heading “## [Unreleased]”'],
    [`${HEAD}${RELEASED}`, 'CHANGELOG.md:5: the first release must be “## [Unreleased]”'],
    [
      `${HEAD}## [Unreleased]\n- One.\n`,
      'CHANGELOG.md:6: an entry must stand under a heading such as “### Added”',
    ],
    [`${HEAD}## [Unreleased]\n### News\n`, 'CHANGELOG.md:6: “### News” is none of Breaking changes, Added'],
    [
      `${HEAD}## [Unreleased]\n### Fixed\n### Added\n`,
      'CHANGELOG.md:7: “Added” must come before “Fixed”, and once in a release',
    ],
    [
      `${HEAD}## [Unreleased]\n\n## 0.1.0\n`,
      'CHANGELOG.md:7: “## 0.1.0” is not of the form “## [1.2.3] - 2026-01-31”',
    ],
  ])('%#', (text, message) => {
    expect(() => readChangelog(text)).toThrow(message);
    expect(() => releaseChangelog(text, '1.0.0', '2026-01-31')).toThrow(message);
  });
});
