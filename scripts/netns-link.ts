/**
 * The whole stack across a link that the kernel makes: two network namespaces, a veth pair between them, tc netem and tbf
 * at both of its ends. Signaling and robot run in one namespace, a command (a shell, a browser) in the other. Takes the
 * options of the link program. Everything is taken down at the end, whatever the end.
 */
import type { ChildProcess } from 'node:child_process';
import { once } from 'node:events';
import { existsSync } from 'node:fs';
import { createInterface } from 'node:readline';
import {
  CapacitySchedule,
  type LinkProfile,
  monotonicMs,
  ProfileError,
  tcQdiscs,
  tcRate,
  tcRatePlace,
} from '@farpoint/link-emulator';
import { OptionsError, resolveOptions } from '@farpoint/service';
import { directionOf } from '../apps/link-emulator/src/directions.ts';
import { program } from '../apps/link-emulator/src/options.ts';
import {
  type Namespace,
  NamespacePair,
  NetworkToolError,
  networkTool,
  spawnIn,
} from './lib/network-namespaces.ts';
import { root, run } from './lib/run.ts';

const BITS_PER_MS_AND_MBPS = 1000;
const split = process.argv.indexOf('--');
const argv = process.argv.slice(2, split === -1 ? undefined : split);
const command = split === -1 ? [process.env.SHELL ?? 'sh'] : process.argv.slice(split + 1);

async function main(): Promise<number> {
  const summary =
    'The whole stack across a link that the kernel makes (root and iproute2 needed): netns-link [options] [-- COMMAND…] runs COMMAND, or a shell, on the operator’s side.';
  const resolved = resolveOptions({ ...program, name: 'netns-link', summary }, { argv, env: process.env });
  if (resolved.action === 'print') {
    process.stdout.write(resolved.text);
    return 0;
  }
  const { values } = resolved;
  const up = directionOf(values, 'up').profile;
  const down = directionOf(values, 'down').profile;
  const tools = await Promise.all([run('ip', ['-V']), run('tc', ['-V'])]);
  if (process.getuid?.() !== 0 || tools.some(({ code }) => code !== 0)) {
    console.error(
      'netns-link needs root and iproute2 (its programs ip and tc): install iproute2 and run this as root',
    );
    return 1;
  }
  const pair = await NamespacePair.create();
  const children: ChildProcess[] = [];
  const stop = new AbortController();
  const interrupt = (): void => stop.abort();
  for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP'] as const) process.on(signal, interrupt);
  try {
    const rates = [follow(pair.robot, up, stop.signal), follow(pair.operator, down, stop.signal)];
    await Promise.all(rates.map(({ set }) => set));
    const start = async (args: string[], ready: string): Promise<void> => {
      const child = spawnIn(pair.robot, [process.execPath, ...args], {
        cwd: root,
        env: { FARPOINT_LOG_FORMAT: 'json' },
        stdout: 'pipe',
      });
      children.push(child);
      await untilLine(child, ready);
    };
    const { address } = pair.robot;
    const web = existsSync(`${root}/apps/webxr/dist/index.html`) ? ['--web-root', 'apps/webxr/dist'] : [];
    await start(['apps/signaling/src/main.ts', '--host', address, ...web], '"msg":"listening"');
    await start(
      [
        'apps/robot-node/src/main.ts',
        '--signaling',
        `ws://${address}:3000`,
        '--id',
        'sim-1',
        '--name',
        'Simulated robot',
      ],
      '"msg":"registered with signaling"',
    );
    const url = `http://${address}:3000/`;
    console.error(`the robot is at ${url}?robot=sim-1 as seen from here: ${command.join(' ')}`);
    const operator = spawnIn(pair.operator, command, {
      cwd: root,
      env: { FARPOINT_WEB: url },
      stdout: 'inherit',
    });
    children.push(operator);
    const failed = Promise.race(rates.map(({ ended }) => ended));
    const ended = once(operator, 'exit').then(([code]) => (code as number | null) ?? 1);
    const interrupted = once(stop.signal, 'abort').then(() => 130);
    return await Promise.race([ended, failed, interrupted]);
  } catch (error) {
    if (stop.signal.aborted) return 130;
    throw error;
  } finally {
    stop.abort();
    await Promise.all(children.map(end));
    await pair.remove();
  }
}

/** Puts a profile on a namespace's device, and changes the rate as the profile says. */
function follow({ name, device }: Namespace, profile: LinkProfile, stop: AbortSignal) {
  const schedule = new CapacitySchedule(profile.capacity, monotonicMs());
  const now = (): number => {
    schedule.seek(monotonicMs());
    return schedule.rate / BITS_PER_MS_AND_MBPS;
  };
  const tc = (verb: string, args: string[]) =>
    networkTool('tc', ['-n', name, 'qdisc', verb, 'dev', device, ...args]);
  const set = (async () => {
    for (const args of tcQdiscs(profile, now())) await tc('add', args);
  })();
  const ended = (async (): Promise<never> => {
    await set;
    while (schedule.segmentEndMs !== Number.POSITIVE_INFINITY && !stop.aborted) {
      const waitMs = Math.max(1, schedule.segmentEndMs - monotonicMs());
      await new Promise((resolve) => setTimeout(resolve, waitMs));
      if (stop.aborted) break;
      await tc('change', [...tcRatePlace(profile), 'handle', '10:', ...tcRate(profile, now())]);
    }
    return new Promise<never>(() => {});
  })();
  ended.catch(() => {});
  return { set, ended };
}

async function untilLine(child: ChildProcess, part: string): Promise<void> {
  const last: string[] = [];
  await new Promise<void>((resolve, reject) => {
    child.once('exit', (code) =>
      reject(new NetworkToolError(`a program ended (${code}): ${last.join('\n')}`)),
    );
    createInterface({ input: child.stdout! }).on('line', (line) => {
      last.push(line);
      if (last.length > 20) last.shift();
      if (line.includes(part)) resolve();
    });
  });
}

async function end(child: ChildProcess): Promise<void> {
  if (child.exitCode !== null || child.signalCode !== null) return;
  const exit = once(child, 'exit');
  child.kill('SIGTERM');
  const timer = setTimeout(() => child.kill('SIGKILL'), 8000);
  await exit;
  clearTimeout(timer);
}

try {
  process.exitCode = await main();
} catch (error) {
  const known =
    error instanceof OptionsError || error instanceof ProfileError || error instanceof NetworkToolError;
  if (!known) throw error;
  const { message } = error;
  const remedy = /qdisc kind is unknown/.test(message)
    ? ' (the kernel has no such module: modprobe sch_netem sch_tbf)'
    : '';
  console.error(`netns-link: ${message}${remedy}`);
  process.exitCode = error instanceof OptionsError ? 2 : 1;
}
// What still waits (a rate to be changed) has nothing left to act on.
process.exit();
