/** `pnpm release`: makes a release of all packages and programs under one version. Nothing leaves this machine. */
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, relative } from 'node:path';
import { parseArgs } from 'node:util';
import { packPackage, publishedPackages } from './lib/published-packages.ts';
import { planRelease, type ReleasePlan, ReleaseRefusal } from './lib/release/plan.ts';
import { commitRelease, readState, restoreFiles, writeRelease } from './lib/release/repository.ts';
import { root, run } from './lib/run.ts';

const HELP = `pnpm release [major|minor|patch|VERSION] [--dry-run] [--tested] [--branch NAME]

Releases all packages and programs under one version. It checks the working tree and CHANGELOG.md, runs every test,
writes the version into each package.json, dates the changelog, packs the published packages into release/, commits and
tags. Nothing is pushed or published; it prints the commands for that.

  VERSION        by default the least that the sections of CHANGELOG.md ask for: after 1.0 a breaking change asks for a
                 major version, an addition for a minor one, a fix for a patch; before 1.0 a breaking change for a minor one
  --dry-run      shows what would be released and packs it elsewhere; changes nothing, needs no network
  --tested       does not run the tests: they have passed for this commit
  --branch NAME  releases from another branch than main
`;

async function main(): Promise<void> {
  const { values, positionals } = readArguments();
  if (values.help) {
    console.log(HELP);
    return;
  }
  const [version] = positionals;
  const request = { version, branch: values.branch, date: new Date().toISOString().slice(0, 10) };
  const plan = planRelease(readState(), request);
  console.log(`${plan.tag}, ${request.date}\n\n${plan.notes}\n`);
  if (values['dry-run']) {
    await packAside();
    console.log(`${plan.tag} can be made once pnpm test passes. Nothing has been changed.`);
    return;
  }
  if (!values.tested) {
    const { code } = await run('pnpm', ['test'], { echo: true, env: { CI: '1' } });
    if (code !== 0) throw new ReleaseRefusal('the tests fail: nothing has been changed');
    // They take a while, in which somebody may have gone on working.
    planRelease(readState(), request);
  }
  await release(plan);
}

async function release(plan: ReleasePlan): Promise<void> {
  let tarballs: string[];
  try {
    await writeRelease(plan);
    tarballs = await pack(join(root, 'release'), plan.version);
    await commitRelease(plan);
  } catch (error) {
    await restoreFiles();
    throw error;
  }
  const files = tarballs.map((file) => relative(root, file));
  console.log(`${plan.tag} is committed and tagged. To publish it:\n\n  git push --follow-tags`);
  for (const file of files) console.log(`  pnpm publish ${file}`);
}

/** @returns the tarballs that it wrote */
async function pack(folder: string, version: string): Promise<string[]> {
  mkdirSync(folder, { recursive: true });
  const files: string[] = [];
  for (const each of publishedPackages) {
    const file = join(folder, `${each.name.replace(/^@/, '').replace('/', '-')}-${version}.tgz`);
    console.log(`packing ${each.name}`);
    await packPackage(each, file);
    files.push(file);
  }
  return files;
}

async function packAside(): Promise<void> {
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-release-'));
  try {
    await pack(folder, 'dry-run');
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function readArguments() {
  try {
    const { values, positionals } = parseArgs({
      allowPositionals: true,
      options: {
        'dry-run': { type: 'boolean', default: false },
        tested: { type: 'boolean', default: false },
        branch: { type: 'string', default: 'main' },
        help: { type: 'boolean', short: 'h', default: false },
      },
    });
    if (positionals.length > 1) throw new ReleaseRefusal(`one version only, not ${positionals.join(' ')}`);
    return { values, positionals };
  } catch (error) {
    throw error instanceof TypeError ? new ReleaseRefusal(error.message) : error;
  }
}

try {
  await main();
} catch (error) {
  console.error(`release: ${error instanceof Error ? error.message : String(error)}`);
  process.exitCode = 1;
}
