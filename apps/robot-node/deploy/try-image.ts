/**
 * Tries the container image, as root, on a machine that may have no image registry. Makes the Dockerfile's base from
 * Debian's and Node's packages, builds the image from this checkout, and runs it as docs/real-robot.md says. Checks
 * its answers to --help and to a missing configuration, a robot with signaling and operators on the host, a camera's
 * shared memory on the host, the health check, and the shutdown.
 *
 *   node apps/robot-node/deploy/try-image.ts [--arch amd64|arm64] [--folder FOLDER]
 *
 * --arch defaults to this machine's; another one is emulated (Debian: qemu-user-static). FOLDER is kept, and its
 * contents are reused. Needs podman, debootstrap, packages from the network, and 4 GB of disk. Takes some 4 minutes,
 * emulated 15.
 */
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { chmodSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { setTimeout as wait } from 'node:timers/promises';
import { parseArgs } from 'node:util';
import { robotSuite, runSuite } from '@farpoint/conformance';
import { freePorts, LocalStack } from '@farpoint/local-stack';
import { SignaledOperator } from '../src/testing/signaled-operator.ts';
import { type Architecture, baseImageOf, CERTIFICATES, makeBase } from './debian-base.ts';
import { type Ended, Podman } from './podman.ts';

const repository = join(import.meta.dirname, '..', '..', '..');
const IMAGE = 'farpoint-robot-try';
const ROBOT = 'farpoint-robot';
const NODE_ARCHITECTURES: Record<Architecture, string> = { amd64: 'x64', arm64: 'arm64' };
const own: Architecture = process.arch === 'arm64' ? 'arm64' : 'amd64';

const { values } = parseArgs({
  options: { arch: { type: 'string', default: own }, folder: { type: 'string' } },
});
if (values.arch !== 'amd64' && values.arch !== 'arm64') throw new Error('--arch is amd64 or arm64');
const architecture: Architecture = values.arch;
const emulated = architecture !== own;
/** Factor by which everything may take longer than on a real processor. */
const patience = emulated ? 10 : 1;

const missing = ['podman', 'debootstrap', 'npm'].filter((program) => spawnSync(program, ['--version']).error);
if (emulated && !emulatorIsThere()) missing.push('qemu-user-static');
if (process.getuid?.() !== 0 || missing.length > 0) {
  console.error(`left out: needs root, podman, debootstrap and npm (missing: ${missing.join(', ')})`);
  process.exit(2);
}

const whole = values.folder ?? mkdtempSync('/var/tmp/farpoint-image-');
const folder = join(whole, architecture);
mkdirSync(folder, { recursive: true });
const etc = join(folder, 'etc');
const state = join(folder, 'state');
const podman = new Podman(folder);
let failures = 0;

function check(what: string, is: boolean, detail = ''): void {
  if (!is) failures++;
  console.log(`${is ? '✓' : '✗'} ${what}${detail === '' ? '' : ` (${detail})`}`);
}

/**
 * The kernel runs the other architecture's programs with an emulator that it opened beforehand (flag F), because the
 * container does not contain one.
 */
function emulatorIsThere(): boolean {
  const entry = `/proc/sys/fs/binfmt_misc/qemu-${architecture === 'arm64' ? 'aarch64' : 'x86_64'}`;
  return existsSync(entry) && /^flags: .*F/m.test(readFileSync(entry, 'utf8'));
}

/**
 * Runs the image as docs/real-robot.md does, but with low limits: not every machine lets podman raise the limits to
 * its own.
 */
function run(flags: readonly string[], ...command: string[]): Ended {
  const limits = ['--ulimit', 'nofile=4096:4096', '--ulimit', 'nproc=4096:4096'];
  const host = ['--network', 'host', '--ipc', 'host', '--arch', architecture, '--pull', 'never'];
  return podman.command('run', ...host, ...limits, ...flags, IMAGE, ...command);
}

function build(): void {
  const dockerfile = join(repository, 'apps/robot-node/Dockerfile');
  const image = baseImageOf(readFileSync(dockerfile, 'utf8'));
  const root = join(folder, 'base');
  console.log(`making ${image.name} for ${architecture} in ${root}`);
  makeBase(root, architecture, image);
  // Importing the base again would make a different image, so that no earlier build could be reused.
  if (podman.command('image', 'exists', image.name).code !== 0) {
    const archive = join(folder, 'base.tar');
    execFileSync('tar', ['-C', root, '-cf', archive, '.']);
    const trust = existsSync(join(root, CERTIFICATES));
    const changes = trust ? ['--change', `ENV NODE_EXTRA_CA_CERTS=${CERTIFICATES}`] : [];
    podman.demand('import', '--arch', architecture, ...changes, archive, `docker.io/library/${image.name}`);
    rmSync(archive);
  }

  console.log('building the image');
  const start = performance.now();
  const options = ['--arch', architecture, '--isolation', 'chroot', '--format', 'docker', '--pull=never'];
  // The stand-in has another digest than the image that the Dockerfile names.
  const base = ['--build-arg', `NODE_IMAGE=${image.name}`];
  podman.demand('build', ...options, ...base, '-f', dockerfile, '-t', IMAGE, repository);
  const seconds = ((performance.now() - start) / 1000).toFixed(0);
  const megabytes = (name: string) => Number(podman.demand('inspect', '-f', '{{.Size}}', name)) / 1e6;
  const [all, below] = [megabytes(IMAGE), megabytes(image.name)];
  const sizes = `${all.toFixed(0)} MB, ${(all - below).toFixed(0)} MB of it upon the base`;
  check('the image is built', true, `${seconds} s; ${sizes}`);
}

function tryAnswers(): void {
  const inside = run(['--rm', '--entrypoint', 'node'], '-p', 'process.arch + " " + process.getuid()').stdout;
  const expected = `${NODE_ARCHITECTURES[architecture]} 1000`;
  check(`it is of ${architecture}, and nobody special’s`, inside === expected, inside);
  const addons = `import { isAvailable as ros2 } from '@farpoint/dds';
    import { isAvailable as sharedMemory } from '@farpoint/shared-memory';
    import { loadSend } from '@farpoint/systemd';
    console.log(ros2() && sharedMemory() && typeof loadSend());`;
  const node = ['--rm', '--entrypoint', 'node', '--workdir', '/app/apps/robot-node'];
  const loaded = run(node, '--input-type=module', '-e', addons);
  check(
    'its addons load, with the library for ROS 2',
    loaded.stdout === 'function',
    loaded.stderr.slice(-200),
  );
  check('it helps', run(['--rm'], '--help').stdout.startsWith('Usage: farpoint-robot [options]'));
  const { code, stderr } = run(['--rm']);
  check('it names the configuration that is not there', code === 2 && stderr.includes('robot.yaml'));
  const written = run(['--rm'], 'init', '--source', 'sim', '--output', '-');
  check('init writes one', written.code === 0 && written.stdout.includes('kind: sim'));
  mkdirSync(etc, { recursive: true });
  writeFileSync(join(etc, 'robot.yaml'), written.stdout);
}

/** @returns flags that pass the configuration to a container */
async function configure(stack: LocalStack): Promise<string[]> {
  const environment = {
    SIGNALING: stack.signalingUrl,
    REFERENCE_SIGNALING: `ws://127.0.0.1:${stack.ports.referenceRobot}`,
    ADMIN_PORT: String((await freePorts(1))[0]),
    ...(emulated ? { SIM_SIZE: '64', MAX_POINTS: '700' } : {}),
  };
  const lines = Object.entries(environment).map(([name, value]) => `FARPOINT_ROBOT_${name}=${value}\n`);
  writeFileSync(join(etc, 'robot.env'), lines.join(''));
  // Whichever user the container has.
  mkdirSync(state, { recursive: true });
  chmodSync(state, 0o777);
  const kept = ['-v', `${state}:/var/lib/farpoint`];
  return ['-v', `${etc}:/etc/farpoint:ro`, ...kept, '--env-file', join(etc, 'robot.env')];
}

function tryDoctor(configured: readonly string[]): void {
  const { findings } = JSON.parse(run(['--rm', ...configured], 'doctor', '--json').stdout) as {
    findings: { check: string; verdict: string; detail: string }[];
  };
  const faults = findings.filter(({ verdict }) => verdict === 'fail');
  // A check that fails because the emulated processor is too slow says nothing about a real one.
  const slow = (check: string) => emulated && ['processor', 'codec', 'source'].includes(check);
  const said = faults.map(({ check, detail }) => `${check}: ${detail}`).join('; ');
  check('the doctor finds nothing to fix', findings.length > 5 && faults.every((f) => slow(f.check)), said);
}

/** Starts the robot as in production, without any privilege that it does not need, and waits until it is healthy. */
async function start(flags: readonly string[], ...command: string[]): Promise<void> {
  const strict = ['--read-only', '--cap-drop', 'all', '--security-opt', 'no-new-privileges'];
  const { code, stderr } = run(['-d', '--name', ROBOT, ...strict, ...flags], ...command);
  if (code !== 0) throw new Error(`the robot does not start: ${stderr}`);
  const begin = performance.now();
  let healthy = false;
  while (!healthy && performance.now() - begin < 60_000 * patience) {
    healthy = podman.command('healthcheck', 'run', ROBOT).code === 0;
    if (!healthy) await wait(500);
  }
  const seconds = ((performance.now() - begin) / 1000).toFixed(1);
  check('it gets healthy, with nothing to write to and no capabilities', healthy, `${seconds} s`);
}

function stop(): void {
  const begin = performance.now();
  podman.command('stop', '-t', '20', ROBOT);
  const seconds = (performance.now() - begin) / 1000;
  const { stdout } = podman.command('inspect', '-f', '{{.State.ExitCode}}', ROBOT);
  check(
    'it stops when asked',
    stdout === '0' && seconds < 10,
    `${seconds.toFixed(1)} s, exit code ${stdout}`,
  );
  podman.command('rm', '-f', ROBOT);
}

async function tryOperator(signaling: string, drives: boolean): Promise<void> {
  const connecting = SignaledOperator.connect(signaling, 'robot-1');
  const operator = await Promise.race([connecting, wait(30_000 * patience, null, { ref: false })]);
  check('an operator is welcomed', operator !== null);
  if (operator === null) return;
  const { client } = operator;
  const seen = async (what: string, is: () => boolean) =>
    check(
      what,
      await Promise.race([client.until(is).then(() => true), wait(30_000 * patience, false, { ref: false })]),
    );
  await seen('gets 20 whole clouds', () => client.completeFrames.length >= 20);
  if (drives) {
    let lease: string | undefined;
    void client.takeLease().then((given) => {
      lease = given;
    });
    const driving = setInterval(() => lease !== undefined && client.drive(lease, 0.3), 20);
    await seen('drives', () => (client.telemetry?.twist.linear.x ?? 0) > 0.1);
    clearInterval(driving);
    await seen(
      'and the robot stops where no more commands come',
      () => client.telemetry?.twist.linear.x === 0,
    );
  }
  await operator.close();
}

/** Checks that a camera program on the host can pass clouds to the robot in the container. */
async function tryCamera(configured: readonly string[], signaling: string): Promise<void> {
  const candidates = [
    process.env.FARPOINT_PYTHON,
    join(repository, '.farpoint/python/bin/python3'),
    'python3',
  ];
  const python = candidates.find((p) => p !== undefined && spawnSync(p, ['-c', 'import numpy']).status === 0);
  if (python === undefined) {
    console.log('- shared memory is left out: needs Python with numpy');
    return;
  }
  const shared = mkdtempSync('/dev/shm/farpoint-image-');
  const example = join(repository, 'examples/synthetic_camera.py');
  const options = ['--folder', shared, '--size', '64', '--fps', '10'];
  const camera = spawn(python, [example, ...options], { stdio: 'ignore' });
  try {
    const user = ['--user', String(process.getuid?.())];
    await start([...configured, ...user], '--source', 'shm', '--shm-folder', shared);
    await tryOperator(signaling, false);
    stop();
  } finally {
    camera.kill();
    rmSync(shared, { recursive: true });
  }
}

async function tryRobot(): Promise<void> {
  const stack = await LocalStack.start({ robots: [] });
  try {
    const configured = await configure(stack);
    tryDoctor(configured);
    await start(configured);
    check(
      'it keeps its key and its emergency stop',
      ['key', 'run'].every((name) => existsSync(join(state, `robot-1.${name}.json`))),
    );
    await tryOperator(stack.signalingUrl, true);
    const client = `ws://127.0.0.1:${stack.ports.referenceClient}`;
    const results = await runSuite(robotSuite, { client, name: 'Robot' }, 'strict');
    for (const { name, fault } of results) check(`conformance: ${name}`, fault === null, fault ?? '');
    stop();
    await tryCamera(configured, stack.signalingUrl);
  } finally {
    const { stdout, stderr } = podman.command('logs', '--tail', '20', ROBOT);
    if (failures > 0) console.log(`${stdout}\n${stderr}`);
    podman.command('rm', '-f', '-i', ROBOT);
    await stack.stop();
  }
}

try {
  build();
  tryAnswers();
  await tryRobot();
} finally {
  if (values.folder === undefined) {
    podman.remove();
    rmSync(whole, { recursive: true, force: true });
  }
}
console.log(failures === 0 ? 'all well' : `${failures} not well`);
process.exitCode = failures === 0 ? 0 : 1;
