import type { TimedBaseState } from '@farpoint/cloud-source';
import {
  encodeJson,
  type NearField,
  nextSequence32,
  type RobotSessionMessage,
  type StageTimings,
  type StreamStatus,
  type Telemetry,
  type TelemetryMessage,
  telemetryCodec,
  zeroTwist,
} from '@farpoint/protocol';
import { BitRate } from '@farpoint/timing';
import type { StageTimer } from '../ground/stage-timer.ts';
import type { MotionStatus } from '../motion/drive/motion-status.ts';
import type { OperatorPeer } from '../send/transport/operator-peer.ts';
import type { StreamSender } from '../send/transport/stream-sender.ts';
import type { StageBoard } from './stage-board.ts';
import type { TelemetryBoard } from './telemetry-board.ts';

/** An operator, as far as it is told what the robot does. */
export interface TelemetryTarget {
  /** Of its session. */
  readonly id: string;
  readonly peer: Pick<OperatorPeer, 'connected' | 'sendTelemetry'>;
  readonly messages: { send(message: RobotSessionMessage): void; readonly stages: Pick<StageBoard, 'due'> };
  /** `null` before it is connected. */
  readonly sender: Pick<StreamSender, 'rate' | 'targetBitsPerSecond' | 'counters'> | null;
  /** Frames that its pacer has dropped, entirely or in part. */
  readonly droppedFrames: number;
  /** @param captureStages the stages up to the encoded cloud */
  status(captureStages: StageTimings, nowMs: number): { stages: StageTimings; stream: StreamStatus };
}

/**
 * On a path that carries less, telemetry is sent less often, because it would take a fifth of the path: every
 * fourth time, five a second.
 */
const NARROW_BITS_PER_SECOND = BitRate.fromMbps(1);
const NARROW_EVERY = 4;
/** Components report once a second, and every 4 s to a narrow path: a multiple of what that gets. */
const COMPONENTS_EVERY = 20;
/** What is near is told ten times a second, and five times to a narrow path, or while nobody drives. */
const NEAR_EVERY = 2;

/** What knows what is around the robot. */
export interface Surroundings {
  /** Whether somebody drives. */
  readonly driven: boolean;
  /** `null` while nobody can tell. */
  nearField(nowMs: number): NearField | null;
}

/**
 * Sends each operator the robot's state, what is near it, statistics of its stream, samples of quantities, alarms,
 * components' reports, up to five readings a second, the navigator's path and map, its model and joints, and when frames
 * and commands passed the robot's stations. Call `send` 20 times a second.
 */
export class TelemetrySender {
  readonly #operators: ReadonlyMap<string, TelemetryTarget>;
  readonly #status: MotionStatus;
  readonly #stages: StageTimer;
  readonly #board: TelemetryBoard;
  readonly #surroundings: Surroundings;
  readonly #near = { wide: new NearFieldRepeats(), narrow: new NearFieldRepeats() };
  #sequence = 0;

  constructor(
    operators: ReadonlyMap<string, TelemetryTarget>,
    status: MotionStatus,
    stages: StageTimer,
    board: TelemetryBoard,
    surroundings: Surroundings,
  ) {
    this.#surroundings = surroundings;
    this.#board = board;
    this.#operators = operators;
    this.#status = status;
    this.#stages = stages;
  }

  send(state: TimedBaseState, nowMs: number): void {
    const alarms = this.#board.alarmChanges(nowMs);
    if (this.#operators.size === 0) return;
    for (const { peer, messages } of this.#operators.values())
      if (peer.connected) for (const alarm of alarms) messages.send(alarm);
    const stages = this.#stages.take();
    this.#sequence = nextSequence32(this.#sequence);
    // Readings go with the telemetry that narrow paths get, too, so that every reading reaches all operators.
    const motion = this.#status.state(nowMs);
    const forNarrow = this.#sequence % NARROW_EVERY === 0;
    const { readings, samples, components, navigation, model } = this.#board;
    if (this.#sequence % COMPONENTS_EVERY === 0) this.#tellOfModel(nowMs);
    const reading = forNarrow ? readings.next(nowMs) : null;
    const all = samples.all();
    const newest = forNarrow ? samples.newest() : null;
    const nearEvery = this.#surroundings.driven ? NEAR_EVERY : NARROW_EVERY;
    const near = this.#sequence % nearEvery === 0 ? this.#surroundings.nearField(nowMs) : null;
    const nearWide = this.#near.wide.next(near, nowMs);
    const nearNarrow = forNarrow ? this.#near.narrow.next(near, nowMs) : null;
    const reports = this.#sequence % COMPONENTS_EVERY === 0 ? components.next(nowMs) : null;
    for (const operator of this.#operators.values()) {
      if (!operator.peer.connected) continue;
      const target = operator.sender?.targetBitsPerSecond ?? 0;
      const isNarrow = target < NARROW_BITS_PER_SECOND;
      if (isNarrow && !forNarrow) continue;
      const message: Telemetry = {
        type: 'telemetry',
        sequence: this.#sequence,
        timeMs: state.timeMs,
        ...(state.measuredMs == null ? {} : { ageMs: Math.max(0, state.timeMs - state.measuredMs) }),
        pose: state.pose,
        twist: state.twist ?? zeroTwist(),
        ...(state.battery === null ? {} : { battery: state.battery }),
        drive: this.#status.drive(nowMs, state.contact),
        motion,
        ...operator.status(stages, nowMs),
        operators: this.#operators.size,
      };
      const send = (each: TelemetryMessage | null) => {
        if (each !== null) operator.peer.sendTelemetry(encodeJson(telemetryCodec, each));
      };
      send(message);
      send(isNarrow ? nearNarrow : nearWide);
      send(isNarrow ? newest : all);
      send(reading);
      if (!isNarrow || this.#sequence % (COMPONENTS_EVERY * NARROW_EVERY) === 0) send(reports);
      const width = isNarrow ? 'narrow' : 'wide';
      for (const each of navigation.next(operator, width, nowMs)) send(each);
      const parts = model.nextParts(operator, width, nowMs);
      if (parts !== null) operator.messages.send(parts);
      send(model.nextJoints(operator, nowMs));
      send(operator.messages.stages.due(nowMs, isNarrow));
    }
  }

  #tellOfModel(nowMs: number): void {
    const reading = this.#board.model.reading(nowMs);
    if (reading !== null) this.#board.readings.add(reading, nowMs);
  }
}

/**
 * What has not changed is repeated this often, so that operators know that it is still so, ms. Chosen: the
 * page calls what is near old after two of these (near-view.ts).
 */
const REPEAT_MS = 500;

/** Leaves out what operators already know. */
class NearFieldRepeats {
  #told = '';
  #toldMs = Number.NEGATIVE_INFINITY;

  /** @returns what is to be sent now; `null` if nothing */
  next(near: NearField | null, nowMs: number): NearField | null {
    if (near === null) return null;
    if (near.sectors === this.#told && nowMs - this.#toldMs < REPEAT_MS) return null;
    this.#told = near.sectors;
    this.#toldMs = nowMs;
    return near;
  }
}
