/** Tests what installs the robot on a machine: unit, install script and image, as far as this machine allows. */
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { dirname, join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import manifest from '../package.json' with { type: 'json' };
import { judgeUnitDevices, unitDevices } from '../src/program/doctor/check-unit.ts';
import { baseImageOf } from './debian-base.ts';

const here = import.meta.dirname;
const repository = join(here, '..', '..', '..');
const unit = join(here, 'farpoint-robot.service');
const has = (program: string, ...args: string[]) => spawnSync(program, args).error === undefined;
const systemd = has('systemd-analyze', '--version');
const compiler = has('cc', '--version') && has('make', '--version') && has('python3', '--version');
const LONG_MS = 300_000;
const versionLine = `farpoint-robot ${manifest.version}\n`;

const folder = useFolder();

/** Runs a program. @returns its exit code and all its output */
function run(program: string, args: string[], options: { cwd?: string; env?: Record<string, string> } = {}) {
  const env = { ...process.env, npm_config_prefer_offline: 'true', ...options.env };
  const { status, stdout, stderr } = spawnSync(program, args, { ...options, env, encoding: 'utf8' });
  return { status, output: `${stdout}${stderr}` };
}

describe.skipIf(!systemd)('the unit (needs systemd-analyze)', () => {
  it('is accepted by systemd', () => {
    // The program that the unit names is not installed here.
    const path = join(folder, 'farpoint-robot.service');
    writeFileSync(path, readFileSync(unit, 'utf8').replace(/^ExecStart=\S+/m, 'ExecStart=/bin/true'));
    expect(run('systemd-analyze', ['verify', '--man=no', path])).toEqual({ status: 0, output: '' });
  });

  it('has an exposure level of at most 2.0 of 10 in systemd’s own analysis', () => {
    const { output } = run('systemd-analyze', ['security', '--offline=true', '--no-pager', unit]);
    const exposure = /Overall exposure level for \S+: ([\d.]+)/.exec(output)?.[1];
    expect(Number(exposure)).toBeLessThanOrEqual(2);
  });
});

it('the unit keeps the access that the robot needs', () => {
  const text = readFileSync(unit, 'utf8');
  // Own addresses, the machine's shared memory, files shared by group, restarts, messages to systemd.
  for (const line of [
    'AF_NETLINK',
    'PrivateIPC=no',
    'RemoveIPC=no',
    'PrivateUsers=no',
    'Restart=on-failure',
    'Type=notify',
  ])
    expect(text).toContain(line);
  expect(text).not.toMatch(/^MemoryDenyWriteExecute=yes/m);
});

it('the unit permits the devices that options name, and no others', () => {
  const text = readFileSync(unit, 'utf8');
  const values = (key: string) =>
    [...text.matchAll(new RegExp(`^${key}=(.*)$`, 'gm'))].map(([, value]) => value);
  // PrivateDevices=yes would hide them, whatever else is permitted.
  expect(values('PrivateDevices')).toEqual(['no']);
  expect(values('DevicePolicy')).toEqual(['closed']);
  expect(values('DeviceAllow')).toEqual(['char-gpiochip r', 'char-alsa rw', 'char-video4linux rw']);
  // What PrivateDevices=yes would take away besides.
  expect(values('CapabilityBoundingSet')).toEqual(['']);
  expect(values('NoNewPrivileges')).toEqual(['yes']);
  expect(values('SystemCallFilter').join()).toContain('@raw-io');
  // A group that the machine does not have would keep the robot from starting.
  expect(values('SupplementaryGroups')).toEqual([]);
  const own = unitDevices(
    values('DeviceAllow')
      .map((each) => `DeviceAllow=${each}`)
      .join('\n'),
  );
  expect(judgeUnitDevices(['/dev/gpiochip0', '/dev/snd', '/dev/video0'], own)).toEqual([]);
});

describe.skipIf(!compiler)('install.sh (needs a C compiler, make and Python 3)', () => {
  it(
    'installs a robot that runs, keeps changed files at an upgrade, and uninstalls completely',
    () => {
      const dest = join(folder, 'root');
      const install = (...args: string[]) => run(join(here, 'install.sh'), ['--dest', dest, ...args]);
      const first = install('--source', 'shm');
      expect(first.status, first.output).toBe(0);
      const robot = join(dest, 'usr/local/bin/farpoint-robot');
      expect(run(robot, ['--version'], { cwd: '/' })).toEqual({
        status: 0,
        output: versionLine,
      });
      const config = join(dest, 'etc/farpoint/robot.yaml');
      const secrets = join(dest, 'etc/farpoint/robot.env');
      expect(readFileSync(config, 'utf8')).toContain('kind: shm');
      expect(readFileSync(config, 'utf8')).toContain('log: /var/lib/farpoint/audit.jsonl');
      expect(statSync(secrets).mode & 0o777).toBe(0o600);
      const doctor = run(
        robot,
        ['doctor', '--json', '--config', config, '--source', 'sim', '--admin-port', '0'],
        { cwd: '/' },
      );
      const { findings } = JSON.parse(doctor.output) as {
        findings: { check: string; verdict: string; detail: string }[];
      };
      // Whether these are enough clouds to drive by is the machine's business.
      expect(findings.find(({ check }) => check === 'source')?.detail).toMatch(/, [1-9]\d* valid points/);
      // The addons were installed: without the one for shared memory, this check would fail.
      expect(findings.find(({ check }) => check === 'shared memory')?.detail).toContain('free in /dev/shm');

      writeFileSync(config, 'robot: {id: mine}\n');
      writeFileSync(secrets, 'FARPOINT_ROBOT_TOKEN=mine\n');
      expect(install('--files-only').status).toBe(0);
      expect([readFileSync(config, 'utf8'), readFileSync(secrets, 'utf8')]).toEqual([
        'robot: {id: mine}\n',
        'FARPOINT_ROBOT_TOKEN=mine\n',
      ]);

      const uninstall = (...args: string[]) => run(join(here, 'uninstall.sh'), ['--dest', dest, ...args]);
      expect(uninstall().status).toBe(0);
      expect(existsSync(join(dest, 'opt/farpoint'))).toBe(false);
      expect(existsSync(robot)).toBe(false);
      expect(existsSync(config)).toBe(true);
      expect(uninstall('--purge').status).toBe(0);
      expect(existsSync(dirname(config))).toBe(false);
    },
    LONG_MS,
  );

  it.each([
    [['--sauce'], 'unknown argument --sauce'],
    [['--source'], '--source needs a kind'],
  ])('refuses %j', (args, message) => {
    const refused = run(join(here, 'install.sh'), args);
    expect(refused.status).not.toBe(0);
    expect(refused.output).toContain(message);
  });
});

/** The instructions of a Dockerfile, with continued lines joined. */
function instructions(path: string): { name: string; text: string }[] {
  const lines = readFileSync(path, 'utf8')
    .replaceAll(/^#.*\n/gm, '')
    .replaceAll(/\\\n/g, ' ')
    .split('\n');
  return lines
    .filter((line) => line.trim() !== '')
    .map((line) => ({
      name: line.split(' ')[0] ?? '',
      text: line
        .slice(line.indexOf(' ') + 1)
        .replaceAll(/\s+/g, ' ')
        .trim(),
    }));
}

describe('the image', () => {
  const dockerfile = instructions(join(here, '..', 'Dockerfile'));

  it('uses standard images only, runs unprivileged, and has a health check', () => {
    const images = dockerfile.filter(({ name }) => name === 'FROM').map(({ text }) => text.split(' ')[0]);
    for (const image of images) expect(image).toBe('$'.concat('{NODE_IMAGE}'));
    const base = dockerfile.find(({ name, text }) => name === 'ARG' && text.startsWith('NODE_IMAGE='));
    expect(base?.text).toMatch(/^NODE_IMAGE=node:\d+-[a-z]+-slim@sha256:[0-9a-f]{64}$/);
    const last = dockerfile.slice(dockerfile.findLastIndex(({ name }) => name === 'FROM'));
    expect(last.find(({ name }) => name === 'USER')?.text).toBe('node');
    expect(last.find(({ name }) => name === 'HEALTHCHECK')?.text).toContain('/healthz');
  });

  it('keeps the state where the documented command mounts a folder of the machine', () => {
    const last = dockerfile.slice(dockerfile.findLastIndex(({ name }) => name === 'FROM'));
    const environment = last.flatMap(({ name, text }) => (name === 'ENV' ? text.split(' ') : []));
    expect(environment).toContain('STATE_DIRECTORY=/var/lib/farpoint');
    // Without a name it would be another one for each container, and the robot could not tell.
    expect(last.filter(({ name }) => name === 'VOLUME')).toEqual([]);
    // For whichever user.
    const made = last.find(({ name, text }) => name === 'RUN' && text.includes('install -d'));
    expect(made?.text).toContain('install -d -m 1777 /var/lib/farpoint');
    const document = readFileSync(join(repository, 'docs/real-robot.md'), 'utf8').replaceAll(/\\\n\s*/g, '');
    const runs = document.split('\n').filter((line) => /^docker run .*farpoint-robot( doctor)?$/.test(line));
    expect(runs).toHaveLength(2);
    for (const line of runs) expect(line).toContain(' -v /var/lib/farpoint:/var/lib/farpoint ');
  });

  it.skipIf(!has('bash', '--version'))('is healthy exactly when the robot says so', async () => {
    const text = dockerfile.find(({ name }) => name === 'HEALTHCHECK')?.text ?? '';
    const [program = '', ...args] = JSON.parse(text.slice(text.indexOf('['))) as string[];
    const asked = (port: number) =>
      new Promise<number | null>((resolve) => {
        const env = { ...process.env, FARPOINT_ROBOT_ADMIN_PORT: String(port) };
        spawn(program, args, { env, stdio: 'ignore' }).once('exit', resolve);
      });
    let answer = 200;
    const server = createServer(({ url }, response) => {
      if (answer === 0) return;
      response.writeHead(url === '/healthz' ? answer : 404).end('{}');
    });
    await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
    const { port } = server.address() as AddressInfo;
    expect(await asked(port)).toBe(0);
    answer = 503;
    expect(await asked(port)).toBe(1);
    // The request hangs: bash's exit code says that it timed out.
    answer = 0;
    expect(await asked(port)).toBeGreaterThan(0);
    server.closeAllConnections();
    await new Promise((resolve) => server.close(resolve));
    expect(await asked(port)).toBe(1);
  });

  it('has a base image whose Node and Debian versions try-image.ts can read', () => {
    const base = baseImageOf(readFileSync(join(here, '..', 'Dockerfile'), 'utf8'));
    expect(base).toEqual({ name: 'node:24-bookworm-slim', node: '24', release: 'bookworm' });
    expect(() => baseImageOf('FROM alpine:3\n')).toThrow('not built upon');
  });

  it.skipIf(!compiler)(
    'has build steps that work on a clean copy of the tree (needs a C compiler, make and Python 3)',
    () => {
      const src = join(folder, 'src');
      const app = join(folder, 'app');
      mkdirSync(app, { recursive: true });
      copyTree(src);
      const env: Record<string, string> = { CI: '1', npm_config_verify_deps_before_run: 'false' };
      for (const { name, text } of dockerfile) {
        const [, argument, value] = (name === 'ARG' && /^(\w+)=(.+)$/.exec(text)) || [];
        if (argument !== undefined && value !== undefined) env[argument] = value;
        if (name === 'RUN' && !text.includes('apt-get')) {
          const step = run('sh', ['-c', text], { cwd: src, env });
          expect(step.status, `${text}\n${step.output}`).toBe(0);
        }
        const copied = /^--from=build (.+) (\S+)$/.exec(text);
        if (name !== 'COPY' || copied === null) continue;
        const [, sources = '', target = ''] = copied;
        for (const source of sources.split(' ')) {
          const from = source.replace(/^\/src/, src);
          const to = target === './' ? join(app, source.replace(/^\/src\//, '')) : join(app, target);
          mkdirSync(dirname(to), { recursive: true });
          cpSync(from, to, { recursive: true, verbatimSymlinks: true });
        }
      }
      rmSync(src, { recursive: true });
      const entry = JSON.parse(
        dockerfile.find(({ name }) => name === 'ENTRYPOINT')?.text ?? '[]',
      ) as string[];
      const main = (entry[1] ?? '').replace(/^\/app/, app);
      expect(run(process.execPath, [main, '--version'], { cwd: '/' }).output).toBe(versionLine);
      const missing = run(process.execPath, [main], {
        cwd: '/',
        env: { FARPOINT_CONFIG: '/etc/farpoint/nothing.yaml' },
      });
      expect(missing).toEqual({
        status: 2,
        output:
          'farpoint-robot: FARPOINT_CONFIG names a file that does not exist: /etc/farpoint/nothing.yaml\n',
      });
    },
    LONG_MS,
  );
});

/** Copies what the build is given: the files that git tracks, minus those in .dockerignore. */
function copyTree(to: string): void {
  const ignored = readFileSync(join(here, '..', 'Dockerfile.dockerignore'), 'utf8')
    .split('\n')
    .filter((line) => /^[a-z]+(\/[a-z-]+)?$/.test(line));
  const files = execFileSync('git', ['ls-files', '--cached', '--others', '--exclude-standard', '-z'], {
    cwd: repository,
    encoding: 'utf8',
  });
  for (const file of files.split('\0').filter((name) => name !== '')) {
    if (
      ignored.some((prefix) => file === prefix || file.startsWith(`${prefix}/`)) ||
      file.endsWith('.test.ts')
    )
      continue;
    const from = join(repository, file);
    if (!existsSync(from)) continue;
    mkdirSync(dirname(join(to, file)), { recursive: true });
    cpSync(from, join(to, file));
  }
}
