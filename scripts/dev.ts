/**
 * `pnpm dev`: the whole local stack: signaling, one simulated robot and the web app. Prints the address to open; Ctrl-C
 * stops everything.
 */
import { parseArgs } from 'node:util';
import { isPortFree, LocalStack, ManagedProcess, repositoryRoot } from '@farpoint/local-stack';

const { values } = parseArgs({
  options: {
    port: { type: 'string', default: '5173' },
    robots: { type: 'string', default: '1' },
    verbose: { type: 'boolean', default: false },
    help: { type: 'boolean', short: 'h', default: false },
  },
});

if (values.help) {
  console.log(`pnpm dev [options]

  --port N     port of the web app (5173)
  --robots N   how many simulated robots (1)
  --verbose    show what every program logs

Signaling listens on 3000 (Farpoint), 3001 and 3002 (reference protocol); robots answer /healthz and /metrics from 9400 up.`);
  process.exit(0);
}

const SIGNALING_PORTS = { signaling: 3000, referenceRobot: 3001, referenceClient: 3002 };
const FIRST_ADMIN_PORT = 9400;
const webPort = readCount('--port', values.port, 65535);
const robotCount = readCount('--robots', values.robots, 16);

const adminPorts = Array.from({ length: robotCount }, (_, index) => FIRST_ADMIN_PORT + index);
for (const port of [...Object.values(SIGNALING_PORTS), webPort, ...adminPorts]) {
  if (!(await isPortFree(port))) {
    console.error(
      `port ${port} is in use: stop what listens there (\`lsof -i :${port}\` names it) and run pnpm dev again`,
    );
    process.exit(1);
  }
}

const onLine = (name: string, line: string): void => {
  if (values.verbose) console.log(`${name.padEnd(10)} ${line}`);
};

let stack: LocalStack | null = null;
let web: ManagedProcess | null = null;
let stopping = false;

async function stop(code: number): Promise<void> {
  if (stopping) return;
  stopping = true;
  await web?.stop();
  await stack?.stop();
  process.exit(code);
}
/** Ctrl-C may come twice: from the terminal, and from pnpm, which hands it on. */
const SAME_SIGNAL_MS = 500;
let askedMs = 0;
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP'] as const) {
  process.on(signal, () => {
    if (!stopping) {
      askedMs = performance.now();
      if (signal === 'SIGINT') console.log('\nstopping');
      void stop(0);
    } else if (performance.now() - askedMs > SAME_SIGNAL_MS) {
      // Asked again: at once. Exiting takes all programs along, which being ended by a signal would not.
      process.exit(1);
    }
  });
}

try {
  console.log('starting signaling and the simulated robot');
  stack = await LocalStack.start({
    ports: SIGNALING_PORTS,
    robots: adminPorts.map((adminPort, index) => ({
      id: `sim-${index + 1}`,
      name: `Simulated robot ${index + 1}`,
      args: ['--source', 'sim', '--sim-seed', String(index + 1), '--pictures-of-cloud'],
      adminPort,
    })),
    onLine,
  });
  console.log('starting the web app');
  web = await ManagedProcess.start({
    name: 'web',
    command: ['node', 'node_modules/vite/bin/vite.js', '--port', String(webPort), '--strictPort'],
    cwd: `${repositoryRoot}/apps/webxr`,
    readyUrl: `http://localhost:${webPort}/`,
    onLine,
  });
} catch (error) {
  if (!stopping) {
    console.error(error instanceof Error ? error.message : error);
    await stop(1);
  }
}

if (stack !== null && web !== null) {
  console.log(`\n  Open  http://localhost:${webPort}/\n\n  Ctrl-C stops everything.\n`);
  const programs = [stack.signaling, web, ...adminPorts.map((_, index) => stack!.robot(`sim-${index + 1}`))];
  const ended = await Promise.race(
    programs.map(async (program) => ({ program, exit: await program.exited })),
  );
  if (!stopping) {
    console.error(
      `${ended.program.name} ended (${ended.exit.signal ?? ended.exit.code}):\n${ended.program.output}`,
    );
    await stop(1);
  }
}

function readCount(flag: string, text: string, most: number): number {
  const value = Number(text);
  if (Number.isInteger(value) && value >= 1 && value <= most) return value;
  console.error(`${flag} ${text}: not a whole number from 1 to ${most}`);
  process.exit(2);
}
