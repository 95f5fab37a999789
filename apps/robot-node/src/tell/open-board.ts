import { NO_PLAYED_TELEMETRY, type PlayedTelemetry } from '@farpoint/cloud-source';
import { MAX_ALARMS, MAX_QUANTITIES, type Quantity } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import { monotonicMs } from '../ground/clock.ts';
import type { Capture } from '../sense/capture/capture.ts';
import type { AlarmRule } from './alarms/alarm-board.ts';
import type { SessionRecording } from './session-recording.ts';
import { TelemetryBoard } from './telemetry-board.ts';

interface BoardOptions {
  /** The numbers of its topics that are shown over time. */
  quantities: readonly Quantity[];
  /** Limits beyond which a value is an alarm. */
  alarms: readonly AlarmRule[];
  /** The model that operators see, as far as no topic tells it. */
  model?: TopicReading | undefined;
}

/** The board of what the robot tells about itself, with what its source plays, and recorded if anything is. */
export function openBoard(
  { quantities, alarms, model }: BoardOptions,
  capture: Pick<Capture, 'description' | 'onTelemetry'>,
  recording: Pick<SessionRecording, 'telemetryTaker'> | null,
  log: Logger,
): TelemetryBoard {
  const played = capture.description.telemetry ?? NO_PLAYED_TELEMETRY;
  const shown = roomFor(played, quantities.length, alarms.length);
  const left = {
    quantities: played.quantities.length - shown.quantities.length,
    alarms: played.alarms.length - shown.alarms.length,
  };
  if (left.quantities + left.alarms > 0)
    log.warn(
      { left },
      'the recording has more quantities or alarms than can be shown: the last are left out',
    );
  const board = new TelemetryBoard(quantities, alarms, shown);
  if (model !== undefined) board.take(model, monotonicMs());
  capture.onTelemetry = (message) => board.play(message);
  const watched = [...alarms, ...shown.alarms].map(({ watches, label }) => ({ watches, label }));
  board.taker = recording?.telemetryTaker(board.quantities, watched) ?? null;
  return board;
}

/** What of a recording can be numbered beside the robot's own. */
function roomFor({ quantities, alarms }: PlayedTelemetry, ownQuantities: number, ownAlarms: number) {
  return {
    quantities: quantities.slice(0, MAX_QUANTITIES - ownQuantities),
    alarms: alarms.slice(0, MAX_ALARMS - ownAlarms),
  };
}
