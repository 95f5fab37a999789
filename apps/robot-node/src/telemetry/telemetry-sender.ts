import { encodeJson, nextSequence32, type Telemetry, telemetryCodec } from '@farpoint/protocol';
import type { DriveGuard } from '@farpoint/safety';
import { BitRate } from '@farpoint/timing';
import type { TimedBaseState } from '../base/base.ts';
import type { OperatorSession } from '../session/operator-session.ts';
import type { ReadingBoard } from './reading-board.ts';
import type { StageTimer } from './stage-timer.ts';

/** On a path that carries less, telemetry is sent less often, because it would take a fifth of the path. */
const NARROW_BITS_PER_SECOND = BitRate.fromMbps(1);
const NARROW_EVERY = 4;

/**
 * Sends each operator the robot's state, statistics of its stream, and up to five readings a second. Call `send` 20
 * times a second.
 */
export class TelemetrySender {
  readonly #operators: ReadonlyMap<string, OperatorSession>;
  readonly #guard: DriveGuard;
  readonly #stages: StageTimer;
  readonly #readings: ReadingBoard;
  #sequence = 0;

  constructor(
    operators: ReadonlyMap<string, OperatorSession>,
    guard: DriveGuard,
    stages: StageTimer,
    readings: ReadingBoard,
  ) {
    this.#readings = readings;
    this.#operators = operators;
    this.#guard = guard;
    this.#stages = stages;
  }

  send(state: TimedBaseState, nowMs: number): void {
    if (this.#operators.size === 0) return;
    const stages = this.#stages.take();
    this.#sequence = nextSequence32(this.#sequence);
    // Readings go with the telemetry that narrow paths get, too, so that every reading reaches all operators.
    const reading = this.#sequence % NARROW_EVERY === 0 ? this.#readings.next(nowMs) : null;
    for (const operator of this.#operators.values()) {
      if (!operator.peer.connected) continue;
      const target = operator.sender?.targetBitsPerSecond ?? 0;
      if (target < NARROW_BITS_PER_SECOND && this.#sequence % NARROW_EVERY !== 0) continue;
      const message: Telemetry = {
        type: 'telemetry',
        sequence: this.#sequence,
        timeMs: state.timeMs,
        pose: state.pose,
        twist: state.twist,
        ...(state.battery === null ? {} : { battery: state.battery }),
        drive: this.#guard.state(nowMs, state.contact),
        ...operator.status(stages, nowMs),
        operators: this.#operators.size,
      };
      operator.peer.sendTelemetry(encodeJson(telemetryCodec, message));
      if (reading !== null) operator.peer.sendTelemetry(encodeJson(telemetryCodec, reading));
    }
  }
}
