import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of operators' sessions: how they began, why they ended, and what was refused. */
export function addSessionMetrics(metrics: PulledMetrics, { counters, operators }: MeasuredRobot): void {
  metrics.sum('sessions_opened', 'Sessions that operators requested', () => counters.sessionsOpened);
  metrics.sums('sessions_ended', 'Sessions that ended, by reason', 'reason', () =>
    counters.sessionsEnded.entries(),
  );
  metrics.sum(
    'ice_restarts',
    'ICE restarts offered to operators that had lost their path',
    () => counters.iceRestarts,
  );
  metrics.sums('revocation_lists', 'Lists of revoked grants that arrived, by outcome', 'outcome', () =>
    counters.revocationLists.entries(),
  );
  const refusals: readonly [what: string, read: () => Iterable<readonly [string, number]>][] = [
    ['session', () => [['robot-full', counters.sessionsRefused]]],
    ['grant', () => counters.grantsRefused.entries()],
    ['resume', () => counters.resumesRefused.entries()],
    ['answer', () => counters.answersIgnored.entries()],
    ['ice-candidate', () => counters.candidatesRefused.entries()],
    ['datagram', () => counters.datagramsRefused.entries()],
    ['message', () => counters.messagesRefused.entries()],
  ];
  metrics.sumsByTwo(
    'refused',
    'What operators sent and the robot refused, by what it was and the reason',
    ['what', 'reason'],
    () =>
      refusals.flatMap(([what, read]) =>
        [...read()].map(([reason, count]) => [what, reason, count] as const),
      ),
  );
  metrics.sums('handovers', 'Ends of requests for the drive and offers of it, by outcome', 'outcome', () =>
    counters.handovers.entries(),
  );
  metrics.sums('command_calls', 'Robot commands that operators gave and that were begun', 'command', () =>
    counters.commandCalls.entries(),
  );
  metrics.sums(
    'command_outcomes',
    'What became of robot commands: how they ended, or why they were refused',
    'outcome',
    () => counters.commandOutcomes.entries(),
  );
  metrics.gauge('operators', 'Operators with a session', () => operators.size);
}

/** Metrics of the connection to the signaling service. */
export function addSignalingMetrics(metrics: PulledMetrics, { counters, signaling }: MeasuredRobot): void {
  metrics.sums('signaling_faults', 'Faults of the connection to signaling, by kind or code', 'kind', () => [
    ...counters.signalingErrors.entries(),
    ['disconnected', signaling.disconnects],
    ['malformed', signaling.malformed],
  ]);
  metrics.gauge('signaling_registered', '1 while registered with the signaling service', () =>
    Number(signaling.registered),
  );
}

/** Metrics of the reference profile. None if the robot does not have it. */
export function addReferenceMetrics(
  metrics: PulledMetrics,
  { reference }: Pick<MeasuredRobot, 'reference'>,
): void {
  if (reference === null) return;
  const gauge = (name: string, help: string, read: () => number) =>
    metrics.gauge(`reference_${name}`, help, read);

  gauge('registered', '1 while the reference signaling has this robot', () => Number(reference.registered));
  gauge('offers', 'Offers made since the start', () => reference.offers);
  gauge('connected', 'Reference operators that connected since the start', () => reference.connected);
  gauge('operators', 'Reference operators now', () => reference.targets.length);
  gauge(
    'bytes_sent',
    'Bytes on the wire to the present reference operator',
    () => reference.operator?.sender?.counters.bytesSent ?? 0,
  );
  gauge(
    'command_bursts',
    'Commands of the present reference operator that had stood in a queue and were taken for a stop',
    () => reference.operator?.driver.bursts ?? 0,
  );
}

/** Metrics of the broadcast. None if the robot does not have one. */
export function addBroadcastMetrics(
  metrics: PulledMetrics,
  { streams: { broadcast } }: Pick<MeasuredRobot, 'streams'>,
): void {
  if (broadcast === null) return;
  metrics.gauge('broadcast_up', '1 while the relay has the robot’s mountpoint', () => Number(broadcast.up));
  metrics.gauge('broadcast_viewers', 'Viewers at the relay', () => broadcast.viewers);
  metrics.sum(
    'broadcast_bytes',
    'Bytes sent to the relay on the wire, all headers counted',
    () => broadcast.bytesSent,
  );
  metrics.sum(
    'broadcast_mountpoints',
    'How often the mountpoint was created',
    () => broadcast.keeper.created,
  );
  metrics.sum(
    'broadcast_failures',
    'Datagrams to the present mountpoint that could not be sent',
    () => broadcast.failures,
  );
}
