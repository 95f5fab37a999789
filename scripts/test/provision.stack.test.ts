/** Installing what is missing, with an apt-get and a pip that only write down what they are asked. */
import { chmodSync, existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { rootCommand } from '../lib/run.ts';
import type { Need } from './needs.ts';
import { provision } from './provision.ts';

let folder: string;
const path = process.env.PATH;
beforeEach(() => {
  folder = testFolder();
  process.env.PATH = `${folder}:${path}`;
});
afterEach(() => {
  process.env.PATH = path;
});

const log = () => readFileSync(join(folder, 'log'), 'utf8').trim().split('\n');

/** @param body shell, after the arguments were written down; `installed NAME` makes the need NAME be there */
function fakeApt(body: string): void {
  const script = `#!/bin/sh
[ "$1" = --version ] && exit 0
echo "$*" >> '${folder}/log'
installed() { touch '${folder}/has-'"$1"; }
calls=$(grep -c "^$1" '${folder}/log')
${body}`;
  writeFileSync(join(folder, 'apt-get'), script);
  chmodSync(join(folder, 'apt-get'), 0o755);
}

const need = (name: string, more: Partial<Need> = {}): Need => ({
  ...{ name, packages: [name], without: name, steps: [] },
  isThere: () => Promise.resolve(existsSync(join(folder, `has-${name}`))),
  ...more,
});
const names = (needs: readonly Need[]) => needs.map(({ name }) => name);
const INSTALL = 'install -y --no-install-recommends';
const INSTALL_ALL = 'shift 3; for name in "$@"; do installed "$name"; done';

describe.skipIf(process.platform === 'win32' || rootCommand()?.length !== 0)(
  'what is missing (needs root)',
  () => {
    it('is installed in one round, and nothing is done where nothing is missing', async () => {
      fakeApt(`[ "$1" = update ] && exit 0; ${INSTALL_ALL}`);
      const needs = [need('janus'), need('coturn')];
      expect(await provision(needs, () => undefined)).toEqual([]);
      expect(log()).toEqual(['update', `${INSTALL} janus coturn`]);
      expect(await provision(needs, () => undefined)).toEqual([]);
      expect(log()).toHaveLength(2);
    });

    it('is tried three times while the mirror is away', async () => {
      fakeApt(`[ $calls -lt 3 ] && exit 100; [ "$1" = update ] && exit 0; ${INSTALL_ALL}`);
      expect(await provision([need('janus')], () => undefined)).toEqual([]);
      expect(log().filter((line) => line === 'update')).toHaveLength(3);
    });

    it('is named if it cannot be had, and keeps nothing else away', async () => {
      fakeApt(`[ "$1" = update ] && exit 0; case "$*" in *nowhere*) exit 100;; esac; ${INSTALL_ALL}`);
      const said: string[] = [];
      const missing = await provision([need('nowhere'), need('janus')], (line) => said.push(line));
      expect(names(missing)).toEqual(['nowhere']);
      expect(said[0]).toBe('missing here: nowhere, janus');
    });

    it('is fetched otherwise where that is possible, and then not installed', async () => {
      fakeApt(`[ "$1" = update ] && exit 0; ${INSTALL_ALL}`);
      const fetched = need('chromium', {
        fetch: () => Promise.resolve(writeFileSync(join(folder, 'has-chromium'), '')),
      });
      const failing = need('firefox', { fetch: () => Promise.resolve() });
      expect(await provision([fetched, failing], () => undefined)).toEqual([]);
      expect(log()).toEqual(['update', `${INSTALL} firefox`]);
    });
  },
);
