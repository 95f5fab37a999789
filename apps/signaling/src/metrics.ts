import { shortHash } from '@farpoint/audit';
import { Counter, Gauge, Histogram, type Logger, type Registry } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import type { Observer, RejectReason, Role } from './observer.ts';

/** Refusals that get a log line each: somebody tried something forbidden. */
const NOTABLE: ReadonlySet<RejectReason> = new Set([
  'unauthorized',
  'robot-id-taken',
  'not-yours',
  'full',
  'slow-consumer',
]);

export interface Counts {
  readonly connections: Readonly<Record<Role, number>>;
  readonly robots: number;
  readonly referenceRobots: number;
  readonly sessions: number;
}

/** Turns what the core reports into metrics and log lines. */
export function createObserver(log: Logger, registry: Registry, counts: () => Counts): Observer {
  addGauges(registry, counts);
  const { opened, ended, relays, relaySeconds, rejects } = countersOf(registry);
  // A misbehaving peer must not be able to fill the log.
  const notable = new TokenBucket({ perSecond: 5, burst: 50 });

  return {
    robotJoined(role, robot, address, tookOver) {
      log.info({ role, robot, address, ...(tookOver ? { tookOver } : {}) }, 'robot joined');
    },
    robotLeft(role, robot) {
      log.info({ role, robot }, 'robot left');
    },
    operatorJoined() {},
    operatorLeft() {},
    sessionOpened(session, robot, operator) {
      opened.inc();
      log.info({ session: shortHash('session', session), robot, operator }, 'session opened');
    },
    sessionClosed(session, reason) {
      ended.inc({ reason });
      log.info({ session: shortHash('session', session), reason }, 'session closed');
    },
    relayed(type, ms) {
      relays.inc({ type });
      relaySeconds.observe(ms / 1000);
    },
    rejected(role, reason, detail) {
      rejects.inc({ role, reason });
      if (NOTABLE.has(reason) && notable.take(performance.now()))
        log.warn({ role, reason, detail }, 'refused');
      else log.debug({ role, reason, detail }, 'refused');
    },
  };
}

/** Metrics of who is connected now. */
function addGauges(registry: Registry, counts: () => Counts): void {
  const registers = [registry];
  new Gauge({
    name: 'farpoint_signaling_connections',
    help: 'Open WebSockets by role.',
    labelNames: ['role'],
    registers,
    collect() {
      for (const [role, value] of Object.entries(counts().connections)) this.set({ role }, value);
    },
  });
  new Gauge({
    name: 'farpoint_signaling_robots',
    help: 'Connected robots, by protocol.',
    labelNames: ['protocol'],
    registers,
    collect() {
      const { robots, referenceRobots } = counts();
      this.set({ protocol: 'farpoint' }, robots);
      this.set({ protocol: 'reference' }, referenceRobots);
    },
  });
  new Gauge({
    name: 'farpoint_signaling_sessions',
    help: 'Sessions being set up or running.',
    registers,
    collect() {
      this.set(counts().sessions);
    },
  });
}

/** Metrics of what has happened. */
function countersOf(registry: Registry) {
  const registers = [registry];
  const opened = new Counter({
    name: 'farpoint_signaling_sessions_total',
    help: 'Sessions opened.',
    registers,
  });
  const ended = new Counter({
    name: 'farpoint_signaling_session_ends_total',
    help: 'Sessions ended by reason.',
    labelNames: ['reason'],
    registers,
  });
  const relays = new Counter({
    name: 'farpoint_signaling_relays_total',
    help: 'Messages relayed by type.',
    labelNames: ['type'],
    registers,
  });
  const relaySeconds = new Histogram({
    name: 'farpoint_signaling_relay_seconds',
    help: 'Time from reading a message to handing it to the receiver’s socket.',
    buckets: [0.00002, 0.00005, 0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.05],
    registers,
  });
  const rejects = new Counter({
    name: 'farpoint_signaling_rejects_total',
    help: 'Messages and connections refused, by role and reason.',
    labelNames: ['role', 'reason'],
    registers,
  });
  return { opened, ended, relays, relaySeconds, rejects };
}
