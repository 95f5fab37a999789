import type { RateSnapshot } from '@farpoint/congestion';
import type { PulledMetrics } from '@farpoint/service';
import { datagramsSent } from '@farpoint/webrtc';
import type { StreamSender } from '../../send/transport/stream-sender.ts';
import type { MeasuredRobot } from './measured-robot.ts';

type Senders = () => readonly StreamSender[];

/** Metrics of the paths to the connected operators: what they carry, and what was sent, resent and dropped. */
export function addPathMetrics(
  metrics: PulledMetrics,
  { operators }: Pick<MeasuredRobot, 'operators'>,
): void {
  const senders = () => [...operators.values()].flatMap(({ sender }) => (sender === null ? [] : [sender]));
  addSentMetrics(metrics, senders);
  addRateMetrics(metrics, senders);
}

/** Metrics of what was sent, resent and dropped. */
function addSentMetrics(metrics: PulledMetrics, senders: Senders): void {
  const total = (read: (sender: StreamSender) => number) => () =>
    senders().reduce((sum, sender) => sum + read(sender), 0);
  const byReason = (read: (sender: StreamSender) => Readonly<Record<string, number>>) => () =>
    senders().flatMap((sender) => Object.entries(read(sender)));
  metrics.gauge(
    'packets_sent',
    'Packets to operators connected now',
    total((sender) => sender.counters.packetsSent),
  );
  metrics.sums(
    'media_datagrams',
    'Datagrams of clouds and videos since the start, by how they left: with others by one system call, one by one, or not',
    'way',
    () => Object.entries(datagramsSent),
  );
  metrics.gauge(
    'bytes_sent',
    'Bytes on the wire to operators connected now',
    total((sender) => sender.counters.bytesSent),
  );
  metrics.gauge(
    'packets_resent',
    'Packets resent because an operator connected now missed them',
    total((sender) => sender.counters.packetsResent),
  );
  metrics.gauges(
    'resends_refused',
    'Missed packets that were not resent, by reason, for operators connected now',
    'reason',
    byReason((sender) => sender.resendRefusals),
  );
  metrics.gauges(
    'frames_dropped',
    'Frames not sent, or only in part, by reason, for operators connected now',
    'reason',
    byReason((sender) => sender.droppedFrames),
  );
}

/** Metrics of the rate control. */
function addRateMetrics(metrics: PulledMetrics, senders: Senders): void {
  /** A value of the path that carries least. With one operator, that is the operator's path. */
  const narrowest = (read: (sender: StreamSender) => number) => () => {
    const values = senders().map(read);
    return values.length === 0 ? Number.NaN : Math.min(...values);
  };
  const rate = (read: (snapshot: RateSnapshot) => number) => narrowest((sender) => read(sender.rate));
  metrics.gauge(
    'rate_estimate_bits_per_second',
    'Estimated rate of the narrowest path',
    rate((snapshot) => snapshot.estimateBitsPerSecond),
  );
  metrics.gauge(
    'rate_target_bits_per_second',
    'Target rate of the narrowest path',
    narrowest((sender) => sender.targetBitsPerSecond),
  );
  metrics.gauge(
    'rate_acknowledged_bits_per_second',
    'Rate that recently arrived at the receiver',
    rate((snapshot) => snapshot.ackedBitsPerSecond),
  );
  metrics.gauge(
    'rate_queue_seconds',
    'Estimated waiting time in the path’s queue',
    rate((snapshot) => snapshot.queueMs / 1000),
  );
  metrics.gauge(
    'rate_loss_ratio',
    'Share of packets lost recently',
    rate((snapshot) => snapshot.lossFraction),
  );
  metrics.gauges('rate_state', 'Operators by state of their rate control', 'state', () =>
    senders().map((sender) => [sender.rate.state, 1]),
  );
}

/** Metrics of what the sensors captured, and what became of their points. */
export function addSensorMetrics(
  metrics: PulledMetrics,
  { counters, streams: { sensors, cameras } }: MeasuredRobot,
): void {
  metrics.sum('frames_captured', 'Clouds captured', () => counters.framesCaptured);
  metrics.sums('clouds_dropped', 'Clouds not captured, or not sent to anybody, by reason', 'reason', () => [
    ['no-buffer', sensors.framesWithoutBuffer],
    ['stale', counters.framesStale],
  ]);
  metrics.sum(
    'source_faults',
    'Temporary faults of the source: no producer, bad clouds',
    () => sensors.faults,
  );
  metrics.sums('points_rejected', 'Points not sent, by reason', 'reason', () =>
    counters.pointsRejected.entries(),
  );
  metrics.sums('stage_seconds', 'Time spent, by stage', 'stage', () => [
    ...counters.stageSeconds.entries(),
    ['pictures', cameras.pictures?.counters.workSeconds ?? 0] as const,
  ]);
  metrics.gauge('points_per_frame', 'Points of the last frame', () => counters.lastPoints);
  metrics.gauge('valid_points', 'Valid points of the last raw cloud', () => counters.lastValidPoints);
  metrics.gauge(
    'frames_per_second_planned',
    'Frames a second that are planned now',
    () => counters.lastFramesPerSecond,
  );
}
