/** Tells the signaling service what the robot does, for the list of robots. */
import type { RobotStatus } from '@farpoint/protocol';
import type { TimedBaseState } from '../base/base.ts';
import type { DriveStation } from '../drive/drive-station.ts';
import type { OperatorSession } from '../session/operator-session.ts';
import type { TelemetryBoard } from '../telemetry/telemetry-board.ts';
import type { SignalingClient } from './signaling-client.ts';
import { type ListStatus, StatusReporter } from './status-reporter.ts';

const LOOK_MS = 250;
/** Slower than this, it stands, m/s and rad/s. */
const STANDS = 0.01;

export interface ListedStatusParts {
  signaling: SignalingClient;
  listStatus: ListStatus;
  maxOperators: number;
  operators: ReadonlyMap<string, OperatorSession>;
  drive: DriveStation;
  board: TelemetryBoard;
  state: () => TimedBaseState | null;
  now: () => number;
}

/** @returns what ends it */
export function tellListedStatus(parts: ListedStatusParts): () => void {
  const { signaling, listStatus, now } = parts;
  if (listStatus === 'off') return () => {};
  const reporter = new StatusReporter(listStatus === 'names');
  let registrations = 0;
  const timer = setInterval(() => {
    if (!signaling.takesStatus) return;
    if (registrations !== signaling.registrations) reporter.reset();
    registrations = signaling.registrations;
    const status = reporter.next(statusOf(parts), now());
    if (status !== null) signaling.send({ type: 'robot.status', status });
  }, LOOK_MS);
  return () => clearInterval(timer);
}

function statusOf({ operators, maxOperators, drive, board, state }: ListedStatusParts): RobotStatus {
  const { leaseHolder } = drive.guard;
  const driver = leaseHolder === null ? undefined : operators.get(leaseHolder)?.operatorName;
  const known = state();
  const battery = known?.battery?.percentage;
  const { linear, angular } = known?.twist ?? { linear: { x: 0, y: 0 }, angular: { z: 0 } };
  return {
    estop: drive.guard.estopState().latched,
    moving: Math.max(Math.hypot(linear.x, linear.y), Math.abs(angular.z)) > STANDS,
    driven: leaseHolder !== null,
    ...{ operators: operators.size, maxOperators, alarms: board.alarms.raised.length },
    ...(driver === undefined ? {} : { driver }),
    // What a base says of its battery is not trusted to be a share.
    ...(battery !== undefined && battery >= 0 && battery <= 1 ? { battery } : {}),
  };
}
