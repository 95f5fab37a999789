/** What the recording that a source plays tells about the robot: quantities, alarms, reports of components. */
import type { Alarm, DiagnosticReport, Quantity } from '@farpoint/protocol';

/** The quantities and alarms of a recording. */
export interface PlayedTelemetry {
  quantities: readonly Pick<Quantity, 'topic' | 'field' | 'label' | 'unit'>[];
  alarms: readonly { watches: string; label: string }[];
}

/** What is due now. Times are of the robot's clock, ms. */
export type PlayedMessage =
  /** @param quantity position in the list of quantities */
  | { kind: 'sample'; quantity: number; value: number; timeMs: number }
  /** @param alarm position in the list of alarms */
  | {
      kind: 'alarm';
      alarm: number;
      state: Pick<Alarm, 'level' | 'text' | 'value' | 'limit' | 'unit' | 'sinceMs'>;
    }
  | { kind: 'diagnostics'; topic: string; reports: readonly DiagnosticReport[]; timeMs: number }
  /** Playing begins anew: no alarm is known to be raised. */
  | { kind: 'restart'; timeMs: number };

export const NO_PLAYED_TELEMETRY: PlayedTelemetry = { quantities: [], alarms: [] };
