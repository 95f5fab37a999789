#!/usr/bin/env node
import { directions, monotonicMs, SignalingInterposer, UdpLink } from '@farpoint/link-emulator';
import {
  fileFault,
  JsonLinesFile,
  type ProgramContext,
  runProgram,
  setNicenessIfPermitted,
} from '@farpoint/service';
import { control } from './control.ts';
import { directionOf } from './directions.ts';
import { registerLinkMetrics } from './metrics.ts';
import { program } from './options.ts';

/** How often the statistics say what the emulator itself did, ms: docs/bad-network.md says so. */
const RIM_INTERVAL_MS = 1000;

type Context = ProgramContext<typeof program.options>;

await runProgram(program, async (context) => {
  const { options, log, health, metrics, shutdown, serveAdmin } = context;
  setNicenessIfPermitted(options.niceness, log, ': a busy processor makes packets late');
  const file = openStatistics(context);
  const counters = registerLinkMetrics(metrics, () => link);
  const link = new UdpLink({
    up: directionOf(options, 'up'),
    down: directionOf(options, 'down'),
    seed: options.seed,
    host: options.host,
    onBin: (direction, bin) => {
      counters.add(direction, bin);
      file?.write({ type: 'bin', direction, ...bin });
    },
  });
  shutdown.onClose('link', () => {
    link.advance();
    link.close();
    return file?.close();
  });
  file?.write({
    type: 'start',
    timeMs: link.startMs,
    ...Object.fromEntries(directions.map((direction) => [direction, link.models[direction].profile])),
  });
  await openFronts(context, link, (fault) => counters.fault(fault));
  const initial = { up: link.models.up.profile, down: link.models.down.profile };
  process.on('message', (data) => {
    try {
      log.info(control(link, data, initial), 'told');
    } catch (error) {
      log.error({ err: error }, 'a message from the parent process cannot be executed');
    }
  });
  const cpu = process.cpuUsage();
  const rim = setInterval(() => file?.write(rimStatistics(link, cpu)), RIM_INTERVAL_MS);
  shutdown.onClose('rim statistics', () => clearInterval(rim));
  health.add('link', () => ({ ok: true, detail: { standIns: link.ports, packets: link.packets } }));
  await serveAdmin({ host: options.adminHost, port: options.adminPort, names: options.adminNames });
});

/** @returns `null` if no statistics are wanted */
function openStatistics({ options, log }: Context): JsonLinesFile | null {
  if (options.stats === null) return null;
  return new JsonLinesFile(options.stats, (error) =>
    log.error(
      { remedy: 'set --stats to a file that can be written' },
      `statistics are not written: ${fileFault(error) ?? error.message}`,
    ),
  );
}

/** Opens a signaling service of our own in front of each configured one, so that its peers' packets take the link. */
async function openFronts(
  { options, log, shutdown }: Context,
  link: UdpLink,
  count: (fault: string) => void,
): Promise<void> {
  const events = {
    onPeer: (side: string, path: string) => log.info({ side, path }, 'peer'),
    onFault: (side: string, fault: string) => {
      count(fault);
      log.debug({ side, fault }, 'candidate left out');
    },
    onError: (error: Error) => log.warn({ err: error }, 'signaling'),
  };
  const { host, port } = options;
  const fronts = [
    { peers: 'farpoint', upstream: options.signaling, port },
    { peers: 'reference-robots', upstream: options.referenceRobots, port: port === 0 ? 0 : port + 1 },
    { peers: 'reference-clients', upstream: options.referenceClients, port: port === 0 ? 0 : port + 2 },
  ] as const;
  for (const { peers, upstream, port: own } of fronts) {
    if (upstream === null) continue;
    const interposer = await SignalingInterposer.open({ link, upstream, host, port: own, peers, events });
    shutdown.onClose(peers, () => interposer.close());
    const url = `ws://${host.includes(':') ? `[${host}]` : host}:${interposer.port}`;
    log.info({ peers, url, upstream }, `point ${peers === 'farpoint' ? 'the robot' : peers} at ${url}`);
  }
}

/** How late the link itself was since the last time, and what it cost. @param cpu when the program began */
function rimStatistics(link: UdpLink, cpu: NodeJS.CpuUsage) {
  const { lateness } = link;
  const { user, system } = process.cpuUsage(cpu);
  const statistics = {
    type: 'rim',
    timeMs: monotonicMs(),
    packets: link.packets,
    ports: link.ports,
    cpuMs: (user + system) / 1000,
    late: {
      packets: lateness.count,
      p50Ms: lateness.quantile(0.5),
      p99Ms: lateness.quantile(0.99),
      maxMs: lateness.maxMs,
    },
  };
  lateness.clear();
  return statistics;
}
