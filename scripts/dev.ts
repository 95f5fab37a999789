/**
 * `pnpm dev`: runs the whole local stack: signaling, one simulated robot and the web app. Prints the address to open.
 * Ctrl-C stops everything.
 */
import { availableParallelism } from 'node:os';
import { setTimeout as delay } from 'node:timers/promises';
import {
  type ChosenPorts,
  choosePorts,
  isPortFree,
  keepRunning,
  LocalStack,
  ManagedProcess,
  PortTaken,
  repositoryRoot,
  simArguments,
} from '@farpoint/local-stack';
import { portHolder } from '@farpoint/service';
import { Backoff } from '@farpoint/timing';
import { DEV_HELP, type DevOptions, readDevOptions } from './lib/dev-options.ts';
import { devVideo } from './lib/dev-video.ts';

/** Leaves a robot's usual port, 9400, free for one that is started beside these. */
const FIRST_ADMIN_PORT = 9410;
const FIRST_WEB_PORT = 5173;
/** Number of last lines shown from a program that failed. */
const SHOWN_LINES = 8;

const options = optionsOrExit();
const { ports, moved } = await portsOrExit(options);
const [signaling, referenceRobot, referenceClient, webPort, ...adminPorts] = ports as [
  ...[number, number, number, number],
  ...number[],
];
for (const { wanted, port } of moved) {
  console.log(`port ${wanted.port} is used by ${holderOf(wanted.port)}: ${wanted.name} uses ${port}`);
}

const onLine = (name: string, line: string): void => {
  if (options.verbose) console.log(`${name.padEnd(10)} ${line}`);
};

let stack: LocalStack | null = null;
let web: ManagedProcess | null = null;
let removeVideo = () => {};
const stopping = new AbortController();

async function stop(code: number): Promise<void> {
  if (stopping.signal.aborted) return;
  stopping.abort();
  await web?.stop();
  await stack?.stop();
  removeVideo();
  process.exit(code);
}
/** Ctrl-C may arrive twice: from the terminal, and from pnpm, which forwards it. */
const SAME_SIGNAL_MS = 500;
let askedMs = 0;
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP'] as const) {
  process.on(signal, () => {
    if (!stopping.signal.aborted) {
      askedMs = performance.now();
      if (signal === 'SIGINT') console.log('\nstopping');
      void stop(0);
    } else if (performance.now() - askedMs > SAME_SIGNAL_MS) {
      // A second Ctrl-C exits immediately. Exiting ends all programs, which dying from a signal would not.
      process.exit(1);
    }
  });
}

const startWeb = async (): Promise<ManagedProcess> => {
  web = await ManagedProcess.start({
    name: 'web',
    command: ['node', 'node_modules/vite/bin/vite.js', '--port', String(webPort), '--strictPort'],
    cwd: `${repositoryRoot}/apps/webxr`,
    readyUrl: `http://localhost:${webPort}/`,
    onLine,
  });
  return web;
};

try {
  console.log('starting signaling and the simulated robot');
  const { args, without, remove } = await devVideo();
  removeVideo = remove;
  if (without !== null) console.log(without);
  const running = await LocalStack.start({
    ports: { signaling, referenceRobot, referenceClient },
    robots: adminPorts.map((adminPort, index) => ({
      id: `sim-${index + 1}`,
      name: `Simulated robot ${index + 1}`,
      args: [
        ...simArguments(availableParallelism()),
        '--sim-commands',
        '--sim-seed',
        String(index + 1),
        ...args,
        // Browsers must recognise the robot the next time, too.
        '--robot-key',
        `${repositoryRoot}/.farpoint/robot-keys/sim-${index + 1}.json`,
      ],
      adminPort,
    })),
    onLine,
  });
  stack = running;
  console.log('starting the web app');
  const page = await startWeb();
  const query = signaling === 3000 ? '' : `?signaling=ws://localhost:${signaling}`;
  console.log(`\n  Open  http://localhost:${webPort}/${query}\n\n  Ctrl-C stops everything.\n`);
  keep(page, startWeb);
  keep(running.signaling, async () => {
    await running.startSignaling();
    return running.signaling;
  });
  adminPorts.forEach((_, index) => {
    const id = `sim-${index + 1}`;
    keep(running.robot(id), async () => {
      await running.restartRobot(id);
      return running.robot(id);
    });
  });
} catch (error) {
  if (!stopping.signal.aborted) {
    console.error(error instanceof Error ? error.message : error);
    await stop(1);
  }
}

/** Restarts a program that ends, and reports it. The others go on. */
function keep(first: ManagedProcess, start: () => Promise<ManagedProcess>): void {
  const { name } = first;
  const again = (waitMs: number) => `; restarting it in ${(waitMs / 1000).toFixed(1)} s`;
  void keepRunning(
    first,
    {
      start,
      backoff: new Backoff({ firstMs: 500, mostMs: 10_000, random: Math.random }),
      now: () => performance.now(),
      wait: async (ms, signal) => {
        // Aborting ends the wait. The caller checks the signal.
        await delay(ms, undefined, { signal }).catch(() => {});
      },
      onEnd: ({ output }, exit, waitMs) => {
        console.error(`${name} has ended (${exit.signal ?? `code ${exit.code}`})${again(waitMs)}`);
        if (exit.signal === null && !options.verbose)
          console.error(output.split('\n').slice(-SHOWN_LINES).join('\n'));
      },
      onFailure: (error, waitMs) =>
        console.error(`${error instanceof Error ? error.message : String(error)}${again(waitMs)}`),
      onStart: () => console.log(`${name} is running again`),
    },
    stopping.signal,
  );
}

function optionsOrExit(): DevOptions {
  try {
    const read = readDevOptions(process.argv.slice(2));
    if (read !== null) return read;
    process.stdout.write(DEV_HELP);
    process.exit(0);
  } catch (error) {
    console.error(`pnpm dev: ${(error as Error).message}`);
    process.exit(2);
  }
}

async function portsOrExit({ port, robots }: DevOptions): Promise<ChosenPorts> {
  const wanted = [
    { name: 'signaling', port: 3000 },
    { name: 'signaling for robots of the reference system', port: 3001 },
    { name: 'signaling for bridges of the reference system', port: 3002 },
    { name: 'the web app', port: port ?? FIRST_WEB_PORT, fixed: port !== null },
    ...Array.from({ length: robots }, (_, index) => ({
      name: `the health of robot sim-${index + 1}`,
      port: FIRST_ADMIN_PORT + index,
    })),
  ];
  try {
    return await choosePorts(wanted, isPortFree);
  } catch (error) {
    if (!(error instanceof PortTaken)) throw error;
    const { name, port: taken } = error.wanted;
    console.error(
      `port ${taken} is used by ${holderOf(taken)}: stop that program, or choose another port for ${name} with --port N, or leave out --port`,
    );
    process.exit(1);
  }
}

function holderOf(port: number): string {
  const holder = portHolder(port);
  return holder === null ? 'another program' : `${holder.program} (process ${holder.pid})`;
}
