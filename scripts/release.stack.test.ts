/** `pnpm release` in a small workspace: with real git and pnpm, without a network. */
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, expect, test } from 'vitest';
import { root } from './lib/run.ts';

const LONG_MS = 120_000;
const CHANGELOG = '# Changelog\n\n## [Unreleased]\n\n### Added\n- All of it.\n';

let folder: string;
const at = (file: string) => join(folder, file);
const read = (file: string) => readFileSync(at(file), 'utf8');
function write(file: string, text: string | object): void {
  mkdirSync(dirname(at(file)), { recursive: true });
  writeFileSync(at(file), typeof text === 'string' ? text : JSON.stringify(text));
}
const git = (...args: string[]) => execFileSync('git', args, { cwd: folder, encoding: 'utf8' }).trim();

beforeEach(() => {
  folder = testFolder();
  for (const file of ['scripts/release.ts', 'scripts/lib', '.gitignore'])
    cpSync(join(root, file), at(file), { recursive: true });
  write('package.json', { name: 'all', version: '0.1.0', private: true, type: 'module' });
  write('pnpm-workspace.yaml', 'packages:\n  - packages/*\n');
  write('packages/shown/package.json', { name: '@test/shown', version: '0.1.0', files: ['index.js'] });
  write('packages/shown/index.js', '');
  write('packages/hidden/package.json', { name: '@test/hidden', version: '0.1.0', private: true });
  write('CHANGELOG.md', CHANGELOG);
  git('init', '--quiet', '--initial-branch', 'main');
  for (const [key, value] of Object.entries({ 'user.name': 'A', 'user.email': 'a@example.org' }))
    git('config', key, value);
  // Neither a person's hooks nor their key.
  git('config', 'core.hooksPath', '/dev/null');
  git('config', 'commit.gpgSign', 'false');
  git('config', 'tag.gpgSign', 'false');
  git('add', '.');
  git('commit', '--quiet', '--message', 'All of it');
});

function release(...args: string[]) {
  const program = at('scripts/release.ts');
  const { status, stdout, stderr } = spawnSync(process.execPath, [program, ...args], {
    cwd: folder,
    encoding: 'utf8',
    env: { ...process.env, npm_config_offline: 'true' },
  });
  return { status, stdout, stderr };
}

test(
  'a release has version, date, tarball, commit and tag',
  () => {
    const { status, stdout, stderr } = release('1.0.0', '--tested');
    expect(stderr).toBe('');
    expect(status).toBe(0);
    expect(stdout).toContain('  git push --follow-tags\n  pnpm publish release/test-shown-1.0.0.tgz\n');
    for (const file of ['package.json', 'packages/shown/package.json', 'packages/hidden/package.json'])
      expect(JSON.parse(read(file))).toMatchObject({ version: '1.0.0' });
    expect(read('CHANGELOG.md')).toMatch(
      /## \[Unreleased\]\n\n## \[1\.0\.0\] - \d{4}-\d\d-\d\d\n\n### Added\n/,
    );
    const packed = execFileSync('tar', ['xOf', at('release/test-shown-1.0.0.tgz'), 'package/package.json']);
    expect(JSON.parse(packed.toString())).toMatchObject({ name: '@test/shown', version: '1.0.0' });
    expect(git('status', '--porcelain')).toBe('');
    expect(git('log', '-1', '--format=%s %D')).toBe('Release 1.0.0 HEAD -> main, tag: v1.0.0');
    expect(git('tag', '--list', '--format=%(contents)', 'v1.0.0')).toBe('v1.0.0\n\n### Added\n- All of it.');
  },
  LONG_MS,
);

test(
  'a dry run changes nothing',
  () => {
    const before = git('rev-parse', 'HEAD');
    const { status, stdout } = release('--dry-run');
    expect(status).toBe(0);
    expect(stdout).toContain('### Added\n- All of it.');
    expect(stdout).toContain('v0.1.0 can be made once pnpm test passes. Nothing has been changed.');
    expect(git('status', '--porcelain', '--ignored')).toBe('');
    expect(git('tag', '--list')).toBe('');
    expect(git('rev-parse', 'HEAD')).toBe(before);
  },
  LONG_MS,
);

test('a refusal is one sentence', () => {
  write('new.txt', '');
  const { status, stdout, stderr } = release('--tested');
  expect({ status, stdout, stderr }).toEqual({
    status: 1,
    stdout: '',
    stderr: 'release: the working tree has changes (new.txt): commit or stash them first\n',
  });
});

test(
  'what fails on the way leaves no trace',
  () => {
    write('packages/shown/package.json', {
      name: '@test/shown',
      version: '0.1.0',
      scripts: { prepack: 'node -e "process.exit(3)"' },
    });
    git('commit', '--quiet', '--all', '--message', 'A package that cannot be packed');
    const { status, stderr } = release('--tested');
    expect(status).toBe(1);
    expect(stderr).toContain('release: @test/shown cannot be packed:');
    expect(git('status', '--porcelain')).toBe('');
    expect(git('tag', '--list')).toBe('');
    expect(read('CHANGELOG.md')).toBe(CHANGELOG);
    expect(existsSync(at('release/test-shown-0.1.0.tgz'))).toBe(false);
  },
  LONG_MS,
);
