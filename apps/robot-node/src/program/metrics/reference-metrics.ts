import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of the reference profile. None if the robot does not have it. */
export function addReferenceMetrics(
  metrics: PulledMetrics,
  { reference }: Pick<MeasuredRobot, 'reference'>,
): void {
  if (reference === null) return;
  const ofStream = (name: 'framesSent' | 'packetsSent' | 'bytesSent') => () =>
    reference.operator?.sender?.counters[name] ?? 0;
  const gauge = (name: string, help: string, read: () => number) =>
    metrics.gauge(`reference_${name}`, help, read);

  gauge('registered', '1 while the reference signaling has this robot', () => Number(reference.registered));
  gauge('offers', 'Offers made since the start', () => reference.offers);
  gauge(
    'answers_refused',
    'Answers that were none to the open offer, since the start',
    () => reference.answersRefused,
  );
  gauge('connected', 'Reference operators that connected since the start', () => reference.connected);
  gauge('operators', 'Reference operators now', () => reference.targets.length);
  gauge('frames_sent', 'Frames sent to the present reference operator', ofStream('framesSent'));
  gauge('packets_sent', 'Packets sent to the present reference operator', ofStream('packetsSent'));
  gauge('bytes_sent', 'Bytes on the wire to the present reference operator', ofStream('bytesSent'));
  gauge(
    'command_bursts',
    'Commands of the present reference operator that had stood in a queue and were taken for a stop',
    () => reference.operator?.driver.bursts ?? 0,
  );
}
