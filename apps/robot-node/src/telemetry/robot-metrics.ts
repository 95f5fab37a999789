import type { RateSnapshot } from '@farpoint/congestion';
import { Counter, Gauge, type Registry } from '@farpoint/service';
import type { Robot } from '../robot.ts';
import type { StreamSender } from '../transport/stream-sender.ts';
import type { ReasonCounts } from './robot-counters.ts';

/** Puts the robot's counters on `/metrics`; they are read when somebody asks. */
export function registerRobotMetrics(registry: Registry, robot: Robot): void {
  const { counters, sensors, signaling } = robot;
  const sum = (name: string, help: string, read: () => number) => {
    new Counter({
      name: `farpoint_robot_${name}_total`,
      help,
      registers: [registry],
      collect() {
        this.reset();
        this.inc(read());
      },
    });
  };
  const sumBy = (name: string, help: string, label: string, counts: Pick<ReasonCounts, 'entries'>) => {
    new Counter({
      name: `farpoint_robot_${name}_total`,
      help,
      labelNames: [label],
      registers: [registry],
      collect() {
        this.reset();
        for (const [reason, count] of counts.entries()) this.inc({ [label]: reason }, count);
      },
    });
  };
  const gauge = (name: string, help: string, read: () => number) => {
    new Gauge({
      name: `farpoint_robot_${name}`,
      help,
      registers: [registry],
      collect() {
        this.set(read());
      },
    });
  };
  /** Of every operator now or ever connected. */
  const overOperators = (read: (sender: StreamSender) => number) => () =>
    [...robot.operators.values()].reduce(
      (total, { sender }) => (sender === null ? total : total + read(sender)),
      0,
    );

  sum('sessions_opened', 'Sessions that operators requested', () => counters.sessionsOpened);
  const { recording } = robot;
  if (recording !== null) {
    sum('recording_messages', 'Messages recorded', () => recording.counts.messages);
    sum('recording_bytes', 'Bytes of the recording', () => recording.counts.bytes);
    sumBy('recording_dropped', 'Items not recorded because the writer did not keep up, by kind', 'kind', {
      entries: () => Object.entries(recording.counts.dropped),
    });
  }
  const { pictures } = robot;
  if (pictures !== null) {
    const made = pictures.counters;
    sum('pictures_made', 'Camera pictures prepared for sending', () => made.made);
    sum(
      'pictures_untouched',
      'Prepared pictures that are the camera’s own files, unchanged',
      () => made.untouched,
    );
    sum('picture_bytes', 'Bytes of the prepared pictures', () => made.bytes);
    sum('picture_thread_seconds', 'Processor time of the picture thread', () => made.workSeconds);
    sum('picture_thread_restarts', 'Restarts of the picture thread', () => made.restarts);
    sumBy('pictures_lost', 'Pictures that could not be prepared, by reason', 'reason', made.lost);
  }
  sum('sessions_refused', 'Sessions refused: too many operators', () => counters.sessionsRefused);
  sumBy('sessions_ended', 'Sessions that ended, by reason', 'reason', counters.sessionsEnded);
  sum(
    'ice_restarts',
    'ICE restarts offered to operators that had lost their path',
    () => counters.iceRestarts,
  );
  sumBy(
    'resumes_refused',
    'Requests to resume a session that were refused',
    'reason',
    counters.resumesRefused,
  );
  sumBy('answers_ignored', 'Answers that were ignored, by reason', 'reason', counters.answersIgnored);
  const { candidatesRefused } = counters;
  sumBy('ice_candidates_refused', 'ICE candidates that were refused, by reason', 'reason', candidatesRefused);
  sumBy(
    'datagrams_refused',
    'Datagrams and packets of sessions that were dropped unread, by reason',
    'reason',
    counters.datagramsRefused,
  );
  sumBy('signaling_errors', 'Errors reported by signaling, by code', 'code', counters.signalingErrors);
  sum('signaling_disconnects', 'Lost connections to signaling', () => signaling.disconnects);
  sum('signaling_malformed', 'Unreadable messages from signaling', () => signaling.malformed);
  sum('commands_accepted', 'Drive commands accepted', () => counters.commandsAccepted);
  sumBy('commands_rejected', 'Drive commands refused, by reason', 'reason', counters.commandsRejected);
  sumBy('messages_refused', 'Unreadable messages, by channel and error', 'reason', counters.messagesRefused);
  sum('frames_captured', 'Clouds captured', () => counters.framesCaptured);
  sum(
    'frames_without_buffer',
    'Clouds not captured because no buffer was free',
    () => sensors.framesWithoutBuffer,
  );
  sum('source_faults', 'Temporary faults of the source: no producer, bad clouds', () => sensors.faults);
  sum('frames_stale', 'Clouds dropped because they were too old when ready', () => counters.framesStale);
  sum('points_sent_per_frame_sum', 'Points of all captured frames', () => counters.pointsCaptured);
  sumBy('points_rejected', 'Points not sent, by reason', 'reason', counters.pointsRejected);
  sumBy('stage_seconds', 'Time spent, by stage', 'stage', counters.stageSeconds);
  sum(
    'watchdog_thread_stops',
    'Stops by the simulated base’s own watchdog',
    () => robot.base?.watchdogStops ?? 0,
  );
  gauge('signaling_registered', '1 while registered with signaling', () => (signaling.registered ? 1 : 0));
  gauge('operators', 'Operators with a session', () => robot.operators.size);
  gauge('points_per_frame', 'Points of the last frame', () => counters.lastPoints);
  gauge('valid_points', 'Valid points of the last raw cloud', () => counters.lastValidPoints);
  gauge(
    'packets_sent',
    'Packets to operators connected now',
    overOperators((s) => s.counters.packetsSent),
  );
  gauge(
    'bytes_sent',
    'Bytes on the wire to operators connected now',
    overOperators((s) => s.counters.bytesSent),
  );
  gauge(
    'frames_per_second_planned',
    'Frames a second that are planned now',
    () => counters.lastFramesPerSecond,
  );
  // Of the path that carries least: with one operator, of that one's.
  const narrowest = (read: (rate: RateSnapshot) => number) => () => {
    const rates = [...robot.operators.values()].flatMap(({ sender }) =>
      sender === null ? [] : [sender.rate],
    );
    return rates.length === 0 ? Number.NaN : Math.min(...rates.map(read));
  };
  gauge(
    'rate_estimate_bits_per_second',
    'Estimated rate of the narrowest path',
    narrowest((rate) => rate.estimateBitsPerSecond),
  );
  gauge('rate_target_bits_per_second', 'Target rate of the narrowest path', () =>
    Math.min(...[...robot.operators.values()].map(({ sender }) => sender?.targetBitsPerSecond ?? Number.NaN)),
  );
  gauge(
    'rate_acknowledged_bits_per_second',
    'Rate that recently arrived at the receiver',
    narrowest((rate) => rate.ackedBitsPerSecond),
  );
  gauge(
    'rate_queue_seconds',
    'Estimated waiting time in the path’s queue',
    narrowest((rate) => rate.queueMs / 1000),
  );
  gauge(
    'rate_loss_ratio',
    'Share of packets lost recently',
    narrowest((rate) => rate.lossFraction),
  );
  new Gauge({
    name: 'farpoint_robot_rate_state',
    help: 'Operators by state of their rate control',
    labelNames: ['state'],
    registers: [registry],
    collect() {
      this.reset();
      for (const { sender } of robot.operators.values())
        if (sender !== null) this.inc({ state: sender.rate.state });
    },
  });
  gauge(
    'packets_resent',
    'Packets resent because an operator connected now missed them',
    overOperators((s) => s.counters.packetsResent),
  );
  const gaugeBy = (
    name: string,
    help: string,
    read: (sender: StreamSender) => Readonly<Record<string, number>>,
  ) => {
    new Gauge({
      name: `farpoint_robot_${name}`,
      help,
      labelNames: ['reason'],
      registers: [registry],
      collect() {
        this.reset();
        for (const { sender } of robot.operators.values()) {
          if (sender === null) continue;
          for (const [reason, count] of Object.entries(read(sender))) this.inc({ reason }, count);
        }
      },
    });
  };
  gaugeBy(
    'resends_refused',
    'Missed packets that were not resent, by reason, for operators connected now',
    (sender) => sender.resendRefusals,
  );
  gaugeBy(
    'frames_dropped',
    'Frames not sent, or only in part, by reason, for operators connected now',
    (sender) => sender.droppedFrames,
  );
  gauge(
    'frames_superseded',
    'Frames not sent because a newer one replaced them, for operators connected now',
    overOperators((s) => s.droppedFrames.superseded + s.droppedFrames.overdue),
  );
  if (pictures === null) return;
  gauge('pictures_sent', 'Pictures sent to operators connected now', () =>
    [...robot.operators.values()].reduce((total, operator) => total + operator.pictures.picturesSent, 0),
  );
  gauge('picture_bytes_sent', 'Bytes on the wire of pictures to operators connected now', () =>
    [...robot.operators.values()].reduce((total, operator) => total + operator.pictures.bytesSent, 0),
  );
  new Gauge({
    name: 'farpoint_robot_pictures_unsent',
    help: 'Pictures not sent, or only in part, by reason, for operators connected now',
    labelNames: ['reason'],
    registers: [registry],
    collect() {
      this.reset();
      for (const operator of robot.operators.values())
        for (const [reason, count] of Object.entries(operator.pictures.drops)) this.inc({ reason }, count);
    },
  });
}
