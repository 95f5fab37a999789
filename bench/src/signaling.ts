/** `pnpm bench signaling`: many robots and operators on the real signaling service. */
import { type ChildProcess, fork } from 'node:child_process';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { freePorts, ManagedProcess, repositoryRoot } from '@farpoint/local-stack';
import { type Bench, distributionCells, numberOption, printJson, printTable } from './report.ts';
import type { ClientPlan, ClientResult, PhaseMessage } from './signaling-clients.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench signaling [--robots 2000] [--operators 2000] [--rate 100] [--candidates 5] [--churn 1] [--json]

Starts the signaling service in one process, and robots and operators on real loopback sockets in another. All connect; then
every operator opens a session with a robot, at --rate sessions a second, and the service relays offer, answer and
--candidates each way. Meanwhile --churn other robots a second come and go, so every operator's list keeps changing.

relayMs: from when a message is handed to the sender's socket until the receiver's socket delivers it, both timed in the
clients' process. bytesPerConnection: growth of the service's resident memory per connection, with all of them idle.`;

export const bench: Bench = {
  name: 'signaling',
  summary: 'relay latency and memory of the signaling service under many robots and operators',
  async run(argv) {
    const { values } = parseArgs({
      args: argv,
      options: {
        robots: { type: 'string', default: '2000' },
        operators: { type: 'string', default: '2000' },
        rate: { type: 'string', default: '100' },
        candidates: { type: 'string', default: '5' },
        churn: { type: 'string', default: '1' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
    });
    if (values.help) return console.log(USAGE);
    const robots = numberOption('robots', values.robots, 1);
    const operators = numberOption('operators', values.operators, 1);
    const [port] = (await freePorts(1)) as [number];
    const plan: ClientPlan = {
      url: `ws://127.0.0.1:${port}`,
      robots,
      operators,
      rate: numberOption('rate', values.rate, 0.1),
      candidates: numberOption('candidates', values.candidates, 0),
      churn: numberOption('churn', values.churn, 0),
    };
    const connections = robots + operators;
    const service = await ManagedProcess.start({
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
        String(connections + 64),
        '--max-connections-per-address',
        String(connections + 64),
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
    let clients: Clients | null = null;
    try {
      const metrics = () => readMetrics(`http://127.0.0.1:${port}/metrics`);
      const idle = await metrics();
      clients = new Clients(plan);
      await clients.reached('connected');
      const connected = await metrics();
      clients.proceed();
      const begin = performance.now();
      await clients.reached('done');
      const seconds = (performance.now() - begin) / 1000;
      const done = await metrics();
      clients.proceed();
      const result = await clients.result;

      const all = Object.values(result.relayMs).flat();
      const relayMs = rounded(distribution(all));
      const connectMs = rounded(distribution(result.connectMs));
      const openMs = rounded(distribution(result.openMs));
      const byType = Object.entries(result.relayMs).map(
        ([type, ms]) => [type, rounded(distribution(ms)), ms.length] as const,
      );
      const bytesPerConnection = Math.round((connected.residentBytes - idle.residentBytes) / connections);
      const serviceCpu = (done.cpuSeconds - connected.cpuSeconds) / seconds;
      const errors = Object.values(result.errors).reduce((sum, count) => sum + count, 0);

      console.log(
        `${robots} robots, ${operators} operators, ${all.length} relays in ${seconds.toFixed(1)} s`,
      );
      printTable(
        ['ms', 'p50', 'p95', 'p99', 'max'],
        [
          ['connect', ...distributionCells(connectMs)],
          ['session.open', ...distributionCells(openMs)],
          ...byType.map(([type, ms]) => [type, ...distributionCells(ms)]),
          ['all relays', ...distributionCells(relayMs)],
        ],
      );
      console.log(
        `${bytesPerConnection} bytes a connection, ${serviceCpu.toFixed(2)} cores, ` +
          `${result.lists} lists (${result.listMegabytes.toFixed(0)} MB), ${errors} errors; ` +
          `timers late (p99): service ${done.loopDelayMs.toFixed(1)} ms, clients ${result.lateMsP99.toFixed(1)} ms`,
      );
      for (const [what, count] of Object.entries(result.errors)) console.log(`  ${count} × ${what}`);
      if (values.json) {
        printJson({
          bench: 'signaling',
          robots,
          operators,
          rate: plan.rate,
          candidates: plan.candidates,
          churn: plan.churn,
          relays: all.length,
          seconds,
          relayMs,
          relayMsByType: Object.fromEntries(byType.map(([type, ms]) => [type, ms])),
          connectMs,
          openMs,
          bytesPerConnection,
          residentBytes: done.residentBytes,
          serviceCpu,
          lateMsP99: { service: done.loopDelayMs, clients: result.lateMsP99 },
          lists: result.lists,
          listMegabytes: result.listMegabytes,
          errors,
        });
      }
    } finally {
      clients?.kill();
      await service.stop();
    }
  },
};

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

async function readMetrics(
  url: string,
): Promise<{ residentBytes: number; cpuSeconds: number; loopDelayMs: number }> {
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
