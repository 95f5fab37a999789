import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of operators' sessions: how they began, why they ended, and what was refused. */
export function addSessionMetrics(metrics: PulledMetrics, { counters, operators }: MeasuredRobot): void {
  const { sessionsEnded, resumesRefused, answersIgnored, candidatesRefused, datagramsRefused } = counters;
  metrics.sum('sessions_opened', 'Sessions that operators requested', () => counters.sessionsOpened);
  metrics.sum('sessions_refused', 'Sessions refused: too many operators', () => counters.sessionsRefused);
  metrics.sums('sessions_ended', 'Sessions that ended, by reason', 'reason', () => sessionsEnded.entries());
  metrics.sum(
    'ice_restarts',
    'ICE restarts offered to operators that had lost their path',
    () => counters.iceRestarts,
  );
  metrics.sums('resumes_refused', 'Requests to resume a session that were refused', 'reason', () =>
    resumesRefused.entries(),
  );
  metrics.sums('grants_refused', 'Operators that were not admitted, by reason', 'reason', () =>
    counters.grantsRefused.entries(),
  );
  metrics.sums('revocation_lists', 'Lists of revoked grants that arrived, by outcome', 'outcome', () =>
    counters.revocationLists.entries(),
  );
  metrics.sums('answers_ignored', 'Answers that were ignored, by reason', 'reason', () =>
    answersIgnored.entries(),
  );
  metrics.sums('ice_candidates_refused', 'ICE candidates that were refused, by reason', 'reason', () =>
    candidatesRefused.entries(),
  );
  metrics.sums(
    'datagrams_refused',
    'Datagrams and packets of sessions that were dropped unread, by reason',
    'reason',
    () => datagramsRefused.entries(),
  );
  metrics.sums('messages_refused', 'Unreadable messages, by channel and error', 'reason', () =>
    counters.messagesRefused.entries(),
  );
  metrics.gauge('operators', 'Operators with a session', () => operators.size);
}

/** Metrics of the connection to the signaling service. */
export function addSignalingMetrics(metrics: PulledMetrics, { counters, signaling }: MeasuredRobot): void {
  metrics.sums('signaling_errors', 'Errors reported by signaling, by code', 'code', () =>
    counters.signalingErrors.entries(),
  );
  metrics.sum('signaling_disconnects', 'Lost connections to signaling', () => signaling.disconnects);
  metrics.sum('signaling_malformed', 'Unreadable messages from signaling', () => signaling.malformed);
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
    'broadcast_key_frame_requests',
    'Requests for key frames by the relay or for lost frames, including those that one key frame served together',
    () => broadcast.keyFrames.requests,
  );
  metrics.sum(
    'broadcast_failures',
    'Datagrams to the present mountpoint that could not be sent',
    () => broadcast.failures,
  );
}
