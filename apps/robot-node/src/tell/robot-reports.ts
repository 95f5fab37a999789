import type { TimedBaseState } from '@farpoint/cloud-source';
import { fileFault, JsonLinesFile, type Logger } from '@farpoint/service';
import type { RobotCounters } from '../ground/robot-counters.ts';
import type { MotionStatus } from '../motion/drive/motion-status.ts';
import type { SessionRecording } from './session-recording.ts';
import { streamStatistics } from './stream-statistics.ts';
import type { TelemetryBoard } from './telemetry-board.ts';
import type { TelemetrySender, TelemetryTarget } from './telemetry-sender.ts';

/**
 * How often operators are told, ms: 20 times a second. Prediction needs as many poses (`pnpm bench
 * prediction`, docs/prediction.md), and a display shows no more of numbers.
 */
const TELEMETRY_MS = 50;
/**
 * How often a line is written to the file of statistics, ms: the bins of the link emulator
 * (docs/bad-network.md).
 */
const STATISTICS_MS = 100;

export interface RobotReportsParts {
  operators: ReadonlyMap<string, TelemetryTarget>;
  counters: RobotCounters;
  telemetry: TelemetrySender;
  board: TelemetryBoard;
  status: MotionStatus;
  recording: SessionRecording | null;
  /** The state of the base; `null` before it is known. */
  state: () => TimedBaseState | null;
  /** One JSON object per line; if undefined, nothing is written. */
  statisticsFile?: string | undefined;
  log: Logger;
  now: () => number;
}

/** What the robot reports periodically: telemetry to operators and the recording, statistics to a file. */
export class RobotReports {
  readonly #parts: RobotReportsParts;
  readonly #timers: NodeJS.Timeout[] = [];
  readonly #statistics: JsonLinesFile | null = null;

  constructor(parts: RobotReportsParts) {
    this.#parts = parts;
    const { statisticsFile, recording, log } = parts;
    if (statisticsFile !== undefined) {
      this.#statistics = new JsonLinesFile(statisticsFile, (error) =>
        log.error(
          { remedy: 'set --measure to a folder that can be written' },
          `statistics are not written: ${fileFault(error) ?? error.message}`,
        ),
      );
    }
    if (this.#statistics !== null || recording !== null) {
      this.#timers.push(setInterval(() => this.#writeStatistics(), STATISTICS_MS));
    }
    this.#timers.push(setInterval(() => this.#sendTelemetry(), TELEMETRY_MS));
  }

  async close(): Promise<void> {
    for (const timer of this.#timers) clearInterval(timer);
    await this.#statistics?.close();
  }

  #sendTelemetry(): void {
    const { state, telemetry, board, recording, status, operators, now } = this.#parts;
    const known = state();
    if (known === null) return;
    board.state(known);
    telemetry.send(known, now());
    recording?.telemetry(known, status, operators.size);
  }

  #writeStatistics(): void {
    const { operators, state, counters, recording, now } = this.#parts;
    const lines = streamStatistics(operators.values(), state(), counters, now());
    for (const line of lines) this.#statistics?.write(line);
    recording?.estimates(lines);
  }
}
