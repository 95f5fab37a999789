/** `pnpm bench signaling`: many robots and operators on the real signaling service. */
import { type ChildProcess, fork } from 'node:child_process';
import { join } from 'node:path';
import { freePorts, ManagedProcess, repositoryRoot } from '@farpoint/local-stack';
import { benchOptions, option } from './bench-options.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import type { ClientPlan, ClientResult, PhaseMessage } from './signaling-clients.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench signaling [--robots 2000] [--operators 2000] [--rate 100] [--candidates 5] [--churn 1] [--json]

Starts the signaling service in one process, and robots and operators on real loopback sockets in another. All connect; then
every operator opens a session with a robot, at --rate sessions a second, and the service relays offer, answer and
--candidates each way. Meanwhile --churn other robots a second come and go, so every operator's list keeps changing.

relayMs: from when a message is handed to the sender's socket until the receiver's socket delivers it, both timed in the
clients' process. bytesPerConnection: growth of the service's resident memory per connection, with all of them idle.`;

const OPTIONS = {
  robots: option.number(2000, { least: 1 }),
  operators: option.number(2000, { least: 1 }),
  rate: option.number(100, { least: 0.1 }),
  candidates: option.number(5),
  churn: option.number(1),
};

export const bench: Bench = {
  name: 'signaling',
  summary: 'relay latency and memory of the signaling service under many robots and operators',
  usage: USAGE,
  async run(argv) {
    const { json, ...load } = benchOptions(argv, OPTIONS);
    const [port] = (await freePorts(1)) as [number];
    const plan: ClientPlan = { url: `ws://127.0.0.1:${port}`, ...load };
    const service = await startService(port, plan);
    let clients: Clients | null = null;
    try {
      const metrics = () => readMetrics(`http://127.0.0.1:${port}/metrics`);
      const idle = await metrics();
      clients = new Clients(plan);
      const figures = figuresOf(plan, await measure(clients, idle, metrics));
      print(plan, figures);
      if (json) printJson(jsonOf(plan, figures));
    } finally {
      clients?.kill();
      await service.stop();
    }
  },
};

function startService(port: number, { robots, operators }: ClientPlan): Promise<ManagedProcess> {
  const connections = String(robots + operators + 64);
  return ManagedProcess.start({
    name: 'signaling',
    command: [
      'node',
      'apps/signaling/src/main.ts',
      '--no-reference',
      '--log-level',
      'warn',
      '--host',
      '127.0.0.1',
      '--port',
      String(port),
      '--public-metrics',
      '--max-connections',
      connections,
      '--max-connections-per-address',
      connections,
      // All of the bench's operators come from here.
      '--relay-bytes-per-second',
      '1000000000',
      '--relay-messages-per-second',
      '1000000',
      // Several operators may share a robot.
      '--max-sessions-per-robot',
      String(Math.ceil(operators / robots)),
    ],
    cwd: repositoryRoot,
    readyUrl: `http://127.0.0.1:${port}/healthz`,
  });
}

interface Measured {
  /** The service's metrics before anyone connected, with all connected, and at the end. */
  idle: Metrics;
  connected: Metrics;
  done: Metrics;
  /** Time in which sessions were set up. */
  seconds: number;
  result: ClientResult;
}

async function measure(clients: Clients, idle: Metrics, metrics: () => Promise<Metrics>): Promise<Measured> {
  await clients.reached('connected');
  const connected = await metrics();
  clients.proceed();
  const begin = performance.now();
  await clients.reached('done');
  const seconds = (performance.now() - begin) / 1000;
  const done = await metrics();
  clients.proceed();
  return { idle, connected, done, seconds, result: await clients.result };
}

type Figures = ReturnType<typeof figuresOf>;

function figuresOf({ robots, operators }: ClientPlan, { idle, connected, done, seconds, result }: Measured) {
  const all = Object.values(result.relayMs).flat();
  return {
    seconds,
    done,
    result,
    relays: all.length,
    relayMs: rounded(distribution(all)),
    relayMsByType: Object.fromEntries(
      Object.entries(result.relayMs).map(([type, ms]) => [type, rounded(distribution(ms))]),
    ),
    connectMs: rounded(distribution(result.connectMs)),
    openMs: rounded(distribution(result.openMs)),
    bytesPerConnection: Math.round((connected.residentBytes - idle.residentBytes) / (robots + operators)),
    serviceCpu: (done.cpuSeconds - connected.cpuSeconds) / seconds,
    errors: Object.values(result.errors).reduce((sum, count) => sum + count, 0),
  };
}

function print({ robots, operators }: ClientPlan, figures: Figures): void {
  const { result, done } = figures;
  console.log(
    `${robots} robots, ${operators} operators, ${figures.relays} relays in ${figures.seconds.toFixed(1)} s`,
  );
  printTable(
    ['ms', 'p50', 'p95', 'p99', 'max'],
    [
      ['connect', ...distributionCells(figures.connectMs)],
      ['session.open', ...distributionCells(figures.openMs)],
      ...Object.entries(figures.relayMsByType).map(([type, ms]) => [type, ...distributionCells(ms)]),
      ['all relays', ...distributionCells(figures.relayMs)],
    ],
  );
  console.log(
    `${figures.bytesPerConnection} bytes a connection, ${figures.serviceCpu.toFixed(2)} cores, ` +
      `${result.lists} lists (${result.listMegabytes.toFixed(0)} MB), ${figures.errors} errors; ` +
      `timers late (p99): service ${done.loopDelayMs.toFixed(1)} ms, clients ${result.lateMsP99.toFixed(1)} ms`,
  );
  for (const [what, count] of Object.entries(result.errors)) console.log(`  ${count} × ${what}`);
}

function jsonOf(plan: ClientPlan, figures: Figures) {
  const { result, done } = figures;
  return {
    bench: 'signaling',
    robots: plan.robots,
    operators: plan.operators,
    rate: plan.rate,
    candidates: plan.candidates,
    churn: plan.churn,
    relays: figures.relays,
    seconds: figures.seconds,
    relayMs: figures.relayMs,
    relayMsByType: figures.relayMsByType,
    connectMs: figures.connectMs,
    openMs: figures.openMs,
    bytesPerConnection: figures.bytesPerConnection,
    residentBytes: done.residentBytes,
    serviceCpu: figures.serviceCpu,
    lateMsP99: { service: done.loopDelayMs, clients: result.lateMsP99 },
    lists: result.lists,
    listMegabytes: result.listMegabytes,
    errors: figures.errors,
  };
}

/** The clients' process. */
class Clients {
  readonly result: Promise<ClientResult>;
  readonly #child: ChildProcess;
  readonly #failed: Promise<never>;
  #onPhase: ((phase: PhaseMessage) => void) | null = null;

  constructor(plan: ClientPlan) {
    this.#child = fork(join(import.meta.dirname, 'signaling-clients.ts'), [JSON.stringify(plan)], {
      serialization: 'advanced',
    });
    this.#failed = new Promise((_, reject) => {
      this.#child.once('exit', (code) => reject(new Error(`the clients' process ended with ${code}`)));
    });
    this.#failed.catch(() => {});
    this.result = new Promise((resolve) => {
      this.#child.on('message', (message: PhaseMessage | ClientResult) => {
        if (typeof message === 'string') this.#onPhase?.(message);
        else resolve(message);
      });
    });
  }

  async reached(phase: PhaseMessage): Promise<void> {
    const reached = new Promise<void>((resolve) => {
      this.#onPhase = (now) => {
        if (now === phase) resolve();
      };
    });
    await Promise.race([reached, this.#failed]);
  }

  proceed(): void {
    this.#child.send('proceed');
  }

  kill(): void {
    this.#child.kill('SIGKILL');
  }
}

/** Metrics of the service's process. */
interface Metrics {
  residentBytes: number;
  cpuSeconds: number;
  loopDelayMs: number;
}

async function readMetrics(url: string): Promise<Metrics> {
  const text = await (await fetch(url)).text();
  const value = (name: string): number => {
    const found = new RegExp(`^${name} (\\S+)$`, 'm').exec(text);
    if (found === null) throw new Error(`the service has no metric ${name}`);
    return Number(found[1]);
  };
  return {
    residentBytes: value('process_resident_memory_bytes'),
    cpuSeconds: value('process_cpu_seconds_total'),
    loopDelayMs: value('nodejs_eventloop_lag_p99_seconds') * 1000,
  };
}
