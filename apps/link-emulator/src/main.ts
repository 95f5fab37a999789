#!/usr/bin/env node
import { directions, monotonicMs, SignalingInterposer, UdpLink } from '@farpoint/link-emulator';
import { fileFault, JsonLinesFile, runProgram, setNiceness } from '@farpoint/service';
import { control } from './control.ts';
import { directionOf } from './directions.ts';
import { registerLinkMetrics } from './metrics.ts';
import { program } from './options.ts';

const RIM_INTERVAL_MS = 1000;

await runProgram(program, async ({ options, log, health, metrics, shutdown, serveAdmin }) => {
  try {
    setNiceness(options.niceness);
  } catch (error) {
    log.info(
      { niceness: options.niceness, reason: (error as Error).message },
      'the system keeps the priority: a busy processor makes packets late',
    );
  }
  const file =
    options.stats === null
      ? null
      : new JsonLinesFile(options.stats, (error) =>
          log.error(
            { remedy: 'set --stats to a file that can be written' },
            `statistics are not written: ${fileFault(error) ?? error.message}`,
          ),
        );
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
    link.tick();
    link.close();
    return file?.close();
  });
  file?.write({
    type: 'start',
    timeMs: link.startMs,
    ...Object.fromEntries(directions.map((direction) => [direction, link.models[direction].profile])),
  });

  const events = {
    onPeer: (side: string, path: string) => log.info({ side, path }, 'peer'),
    onFault: (side: string, fault: string) => {
      counters.fault(fault);
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
  for (const front of fronts) {
    if (front.upstream === null) continue;
    const { peers, upstream } = front;
    const interposer = await SignalingInterposer.open({
      link,
      upstream,
      host,
      port: front.port,
      peers,
      events,
    });
    shutdown.onClose(peers, () => interposer.close());
    const url = `ws://${host.includes(':') ? `[${host}]` : host}:${interposer.port}`;
    log.info({ peers, url, upstream }, `point ${peers === 'farpoint' ? 'the robot' : peers} at ${url}`);
  }

  const initial = { up: link.models.up.profile, down: link.models.down.profile };
  process.on('message', (data) => {
    try {
      log.info(control(link, data, initial), 'told');
    } catch (error) {
      log.error({ err: error }, 'a message from the parent process cannot be executed');
    }
  });
  const cpu = process.cpuUsage();
  const rim = setInterval(() => {
    const { lateness } = link;
    const { user, system } = process.cpuUsage(cpu);
    file?.write({
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
    });
    lateness.clear();
  }, RIM_INTERVAL_MS);
  shutdown.onClose('rim statistics', () => clearInterval(rim));

  health.add('link', () => ({ ok: true, detail: { standIns: link.ports, packets: link.packets } }));
  await serveAdmin({ host: options.adminHost, port: options.adminPort, names: options.adminNames });
});
