import {
  decodeJson,
  type ProtocolError,
  type RobotSessionMessage,
  robotSessionCodec,
} from '@farpoint/protocol';
import { type DriveGuardOptions, MotionSupervisor, type RejectedCommand } from '@farpoint/safety';
import { commandOf, makeGuard } from '@farpoint/safety/testing';
import { onTestFinished } from 'vitest';
import { DriveStation } from '../../../motion/drive/drive-station.ts';
import { OperatorMessages, type SessionHost } from '../operator-messages.ts';

/** A robot with the real guard, on a simulated clock; operators come and go. Closed after the test. */
export function sessionRobot(options: Partial<DriveGuardOptions> = {}) {
  let nowMs = 1000;
  let speed = 0;
  const now = () => nowMs;
  const guard = makeGuard(options);
  const drive = new DriveStation(
    new MotionSupervisor(guard),
    (twist) => {
      speed = twist.linear.x;
    },
    now,
  );
  onTestFinished(() => drive.close());
  const sessions: OperatorMessages[] = [];
  const { host, ...told } = recordingHost(drive, sessions, now);
  return {
    ...told,
    guard,
    operator: (id: string) => joinOperator(id, host, sessions),
    speed: () => speed,
    pass: (ms: number) => {
      nowMs += ms;
      drive.apply();
    },
  };
}

/** The host of these sessions, and what it is told of them. */
function recordingHost(drive: DriveStation, sessions: readonly OperatorMessages[], now: () => number) {
  const tests: [string, number, number][] = [];
  const unread: [string, string][] = [];
  const refused: string[] = [];
  const limited = new Set<string>();
  const rejected: RejectedCommand[] = [];
  const tellEstop = () => {
    for (const session of sessions) session.sendEstop();
  };
  const host: SessionHost = {
    drive,
    now,
    estopChanged: tellEstop,
    estopRenewed: tellEstop,
    leaseChanged: () => {
      for (const session of sessions) session.sendLease();
    },
    latencyTestRequested: (session, id, commandMs) => tests.push([session.id, id, commandMs]),
    commandAccepted: () => undefined,
    commandRejected: (rejection) => rejected.push(rejection),
    messageRefused: (channel: string, error: ProtocolError) => unread.push([channel, error.code]),
    messageLimited: (kind) => limited.add(kind),
    refused: (_, what, reason) => refused.push(`${what} ${reason}`),
  };
  return { host, tests, unread, refused, limited, rejected };
}

/** An operator who opens one more session. */
function joinOperator(id: string, host: SessionHost, sessions: OperatorMessages[]) {
  const inbox: RobotSessionMessage[] = [];
  const control: string[] = [];
  const session = new OperatorMessages(id, id, host, {
    // The operator's own decoder must be able to read what the robot sends.
    sendSession: (text) => inbox.push(decodeJson(robotSessionCodec, text)),
    sendControl: (text) => control.push(text),
  });
  sessions.push(session);
  const send = (message: object, channel: 'session' | 'control' = 'session') =>
    session.onMessage(channel, JSON.stringify(message));
  return {
    session,
    inbox,
    control,
    send,
    command: (sequence: number, lease: string, x: number, more: object = {}) =>
      send({ ...commandOf(x, 0, { sequence, timeMs: host.now(), lease }), ...more }, 'control'),
    takeLease: () => {
      host.drive.guard.onOpenHand(id);
      send({ type: 'leaseRequest', take: false });
      const state = inbox.at(-1);
      return state?.type === 'lease' ? (state.lease ?? '') : '';
    },
  };
}
