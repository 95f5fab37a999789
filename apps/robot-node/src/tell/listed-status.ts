/** Tells the signaling service what the robot does, for the list of robots. */
import type { TimedBaseState } from '@farpoint/cloud-source';
import type { RobotToService } from '@farpoint/protocol';
import type { DriveStation } from '../motion/drive/drive-station.ts';
import { type ListStatus, type OwnStatus, StatusReporter } from './status-reporter.ts';
import type { TelemetryBoard } from './telemetry-board.ts';

/**
 * How often the robot looks whether there is something to tell, ms. Chosen: a STOP is in the list within a second, with the
 * half that the service may wait. listed-status.test.ts holds it.
 */
const LOOK_MS = 250;

/** An operator, as far as it is counted. */
export interface CountedOperator {
  readonly operatorName: string;
  readonly peer: { readonly connected: boolean };
  readonly messages: { readonly access: { readonly role: string | null } };
}

export interface ListedStatusParts {
  /** The connection to the signaling service. */
  readonly signaling: {
    /** Whether the service can be told now. */
    readonly takesStatus: boolean;
    /** How often the robot has introduced itself. */
    readonly registrations: number;
    send(message: RobotToService): boolean;
  };
  readonly listStatus: ListStatus;
  readonly version: string;
  readonly maxOperators: number;
  readonly operators: ReadonlyMap<string, CountedOperator>;
  readonly guard: Pick<DriveStation['guard'], 'leaseHolder' | 'hasWheels' | 'estopState'>;
  readonly board: { readonly alarms: Pick<TelemetryBoard['alarms'], 'raised'> };
  /** The state of the base; `null` before it is known. */
  readonly state: () => Pick<TimedBaseState, 'battery'> | null;
  readonly now: () => number;
}

/** @returns ends it */
export function tellListedStatus(parts: ListedStatusParts): () => void {
  const { signaling, listStatus, now } = parts;
  if (listStatus === 'off') return () => {};
  const reporter = new StatusReporter(listStatus === 'names');
  let registrations = 0;
  const timer = setInterval(() => {
    if (!signaling.takesStatus) return;
    if (registrations !== signaling.registrations) reporter.reset();
    registrations = signaling.registrations;
    const status = reporter.next(ownStatus(parts), now(), Date.now());
    if (status !== null) signaling.send({ type: 'robot.status', status });
  }, LOOK_MS);
  return () => clearInterval(timer);
}

function ownStatus({ operators, maxOperators, guard, board, state, version }: ListedStatusParts): OwnStatus {
  const holder = guard.leaseHolder;
  const driver = holder === null ? undefined : operators.get(holder)?.operatorName;
  const present = [...operators.values()].filter(({ peer }) => peer.connected);
  const battery = state()?.battery?.percentage;
  return {
    state: stateOf(guard),
    holder,
    operators: present.length,
    watchers: present.filter(({ messages }) => messages.access.role === 'watch').length,
    maxOperators,
    alarms: board.alarms.raised.length,
    version,
    ...(driver === undefined ? {} : { driver }),
    // What a base says of its battery is not trusted to be a share.
    ...(battery !== undefined && battery >= 0 && battery <= 1 ? { battery } : {}),
  };
}

function stateOf(guard: ListedStatusParts['guard']): OwnStatus['state'] {
  if (guard.estopState().latched) return 'stopped';
  if (!guard.hasWheels) return 'fault';
  return guard.leaseHolder === null ? 'free' : 'driven';
}
