/**
 * Tries the unit under a real systemd, as root. Makes a Debian system in a folder, boots it in a container, installs
 * the robot there from this checkout as docs/real-robot.md says, and checks how it starts, fails, recovers and is
 * removed.
 *
 *   node apps/robot-node/deploy/try-unit.ts [FOLDER]    FOLDER is kept, and used again if it is there
 *
 * Needs debootstrap, systemd-nspawn (Debian: systemd-container) and packages from the network. Takes some 3 minutes.
 */
import { type ChildProcess, execFileSync, spawn, spawnSync } from 'node:child_process';
import { chmodSync, copyFileSync, cpSync, existsSync, mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import { dirname, join } from 'node:path';
import { setTimeout as wait } from 'node:timers/promises';

const repository = join(import.meta.dirname, '..', '..', '..');
const PACKAGES = 'systemd,systemd-sysv,dbus,build-essential,python3,cyclonedds-dev';
const CERTIFICATES = '/etc/ssl/certs/of-the-host.crt';
const UNIT = 'farpoint-robot';

const missing = ['debootstrap', 'systemd-nspawn', 'nsenter'].filter((program) => spawnSync(program).error);
if (process.getuid?.() !== 0 || missing.length > 0) {
  console.error(`left out: needs root, debootstrap and systemd-container (missing: ${missing.join(', ')})`);
  process.exit(2);
}
const given = process.argv[2];
const folder = given ?? mkdtempSync('/var/tmp/farpoint-unit-');
let failures = 0;
const started: { container?: ChildProcess; signaling?: ChildProcess } = {};

function check(what: string, is: boolean, detail = ''): void {
  if (!is) failures++;
  console.log(`${is ? '✓' : '✗'} ${what}${detail === '' ? '' : ` (${detail})`}`);
}

/** Runs a shell command in the container. @returns its exit code and all its output */
function inside(line: string): { code: number | null; output: string } {
  const leader = execFileSync('pgrep', ['-P', String(started.container?.pid)], { encoding: 'utf8' }).trim();
  const env = ['PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin', 'HOME=/root'];
  if (existsSync(join(folder, CERTIFICATES))) env.push(`NODE_EXTRA_CA_CERTS=${CERTIFICATES}`);
  const enter = ['-t', leader, '-m', '-u', '-i', '-p', '-n', '-C', 'env', '-i', ...env, 'sh', '-c', line];
  const { status, stdout, stderr } = spawnSync('nsenter', enter, { encoding: 'utf8' });
  return { code: status, output: `${stdout}${stderr}`.trim() };
}

const show = (property: string): string => inside(`systemctl show -P ${property} ${UNIT}`).output;

/** @returns how long it took until the condition was true, s; `null` if it was not within `mostS` */
async function until(is: () => boolean, mostS: number): Promise<number | null> {
  for (const start = performance.now(); ; await wait(100)) {
    const seconds = (performance.now() - start) / 1000;
    if (is()) return seconds;
    if (seconds > mostS) return null;
  }
}

/** A Debian system with systemd, this Node and its npm. */
function makeSystem(): void {
  if (existsSync(join(folder, 'usr/local/bin/npx'))) return;
  console.log(`making a Debian system in ${folder}`);
  execFileSync('debootstrap', ['--variant=minbase', `--include=${PACKAGES}`, 'bookworm', folder], {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  // The folder is the container's root, so its users must have access.
  chmodSync(folder, 0o755);
  const npx = execFileSync('readlink', ['-f', execFileSync('which', ['npx'], { encoding: 'utf8' }).trim()]);
  const npm = join(folder, 'usr/local/lib/node_modules/npm');
  cpSync(dirname(dirname(npx.toString().trim())), npm, { recursive: true, dereference: true });
  copyFileSync(process.execPath, join(folder, 'usr/local/bin/node'));
  const headers = [dirname(dirname(process.execPath)), '/usr']
    .map((prefix) => join(prefix, 'include/node'))
    .find((path) => existsSync(path));
  if (headers !== undefined) cpSync(headers, join(folder, 'usr/local/include/node'), { recursive: true });
  execFileSync('ln', ['-sf', '../lib/node_modules/npm/bin/npx-cli.js', join(folder, 'usr/local/bin/npx')]);
  const authorities = process.env.NODE_EXTRA_CA_CERTS;
  if (authorities !== undefined) {
    mkdirSync(dirname(join(folder, CERTIFICATES)), { recursive: true });
    copyFileSync(authorities, join(folder, CERTIFICATES));
  }
}

async function freePort(): Promise<number> {
  const server = createServer();
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address() as { port: number };
  await new Promise((resolve) => server.close(resolve));
  return port;
}

async function boot(): Promise<void> {
  const options = [
    '--boot',
    '--register=no',
    '--keep-unit',
    '--resolv-conf=bind-host',
    '--machine=farpoint-try',
  ];
  started.container = spawn(
    'systemd-nspawn',
    ['-q', '-D', folder, ...options, `--bind-ro=${repository}:/src`],
    {
      stdio: 'ignore',
      detached: true,
    },
  );
  await wait(1000);
  const up = await until(() => /running|degraded/.test(inside('systemctl is-system-running').output), 60);
  if (up === null) throw new Error('the container does not boot');
}

async function tryUnit(): Promise<void> {
  const port = await freePort();
  const main = join(repository, 'apps/signaling/src/main.ts');
  started.signaling = spawn(process.execPath, [main, '--port', String(port), '--no-reference'], {
    stdio: 'ignore',
  });
  const installed = inside('/src/apps/robot-node/deploy/install.sh --source sim');
  check('install.sh installs', installed.code === 0, installed.code === 0 ? '' : installed.output);
  inside(`sed -i 's#url: ws://.*#url: ws://127.0.0.1:${port}#' /etc/farpoint/robot.yaml`);
  inside(`echo FARPOINT_ROBOT_ADMIN_PORT=${await freePort()} >> /etc/farpoint/robot.env`);

  check('it starts and says so', inside(`systemctl start ${UNIT}`).code === 0, show('StatusText'));
  const registered = await until(() => show('StatusText').endsWith('; registered'), 10);
  check('its status says that it is registered', registered !== null, show('StatusText'));
  const journal = `journalctl _SYSTEMD_INVOCATION_ID=${show('InvocationID')} -o json --no-pager`;
  const entries = inside(journal).output.split('\n');
  check('each of its lines in the journal is a record of that priority', entries.every(isRecord));
  const asRobot = `systemd-run --pipe --wait --collect -q -p User=farpoint -p EnvironmentFile=/etc/farpoint/robot.env`;
  const doctor = inside(`${asRobot} farpoint-robot doctor --config /etc/farpoint/robot.yaml`);
  check('the doctor finds nothing to fix', doctor.code === 0, doctor.output.split('\n').at(-1));
  const exposure = inside(`systemd-analyze security ${UNIT} --no-pager`).output.split('\n').at(-1) ?? '';
  check('it is exposed little', exposure.includes('OK'), exposure.replace(/^\W*/, ''));

  for (const [what, signal, mostS] of [
    ['a robot that hangs is started again', 'STOP', 16],
    ['a robot that is killed is started again', 'KILL', 5],
  ] as const) {
    const before = Number(show('NRestarts'));
    inside(`kill -${signal} ${show('MainPID')}`);
    const back = () => Number(show('NRestarts')) > before && show('ActiveState') === 'active';
    const seconds = await until(back, mostS);
    check(what, seconds !== null, `${seconds?.toFixed(1) ?? `not in ${mostS}`} s`);
  }
  const start = performance.now();
  inside(`systemctl stop ${UNIT}`);
  const seconds = (performance.now() - start) / 1000;
  check('it stops cleanly', show('Result') === 'success' && seconds < 5, `${seconds.toFixed(1)} s`);

  const before = inside('cat /etc/farpoint/*').output;
  const again = inside('/src/apps/robot-node/deploy/install.sh');
  check(
    'an upgrade keeps the configuration',
    again.code === 0 && inside('cat /etc/farpoint/*').output === before,
  );
  check('uninstall.sh --purge', inside('/src/apps/robot-node/deploy/uninstall.sh --purge').code === 0);
  const left = inside(
    "find / -xdev -name '*farpoint*' -not -path '/src/*' -not -path '/proc/*'; id -un farpoint 2>&1",
  );
  check('leaves nothing', /^id: \S+ no such user$/.test(left.output), left.output.replaceAll('\n', ' '));
}

/** Whether the entry is one of our records, with the journal's priority for its level. */
function isRecord(entry: string): boolean {
  try {
    const { MESSAGE, PRIORITY } = JSON.parse(entry) as { MESSAGE: string; PRIORITY: string };
    const { level } = JSON.parse(MESSAGE) as { level: string };
    return PRIORITY === { debug: '7', info: '6', warn: '4', error: '3', fatal: '2' }[level];
  } catch {
    return false;
  }
}

try {
  makeSystem();
  await boot();
  await tryUnit();
} finally {
  started.signaling?.kill();
  if (started.container !== undefined) {
    inside('systemctl poweroff');
    await until(() => started.container?.exitCode !== null, 20);
    started.container.kill('SIGKILL');
  }
  if (given === undefined) rmSync(folder, { recursive: true, force: true });
}
console.log(failures === 0 ? 'all well' : `${failures} not well`);
process.exitCode = failures === 0 ? 0 : 1;
