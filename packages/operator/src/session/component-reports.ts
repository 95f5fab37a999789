/** What the robot's components report about themselves, put together from messages that have some of the reports each. */
import { type DiagnosticReport, type Diagnostics, diagnosticLevels } from '@farpoint/protocol';

/** The components of one topic. */
export interface ReportedComponents {
  /** Where the reports come from. */
  topic: string;
  /** When the newest report came, robot's monotonic clock, ms. */
  timeMs: number;
  /** Number of components by level, as the robot counts. */
  counts: Diagnostics['counts'];
  /** Whether they come from a recording that the robot plays. */
  recorded: boolean;
  /** Those that are known here: the most urgent level first, and of each level, those that have it the shortest first. */
  reports: readonly DiagnosticReport[];
}

interface Topic {
  timeMs: number;
  readonly recorded: boolean;
  counts: Diagnostics['counts'];
  readonly reports: Map<string, { report: DiagnosticReport; timeMs: number }>;
}

/** More than any robot's nodes that publish diagnostics. */
const MOST_TOPICS = 8;
/** As many as the robot keeps. */
const MOST_REPORTS = 1024;

/** The newest report of each of the robot's components. */
export class ComponentReports {
  readonly #topics = new Map<string, Topic>();

  /** Takes some of the reports. The channel is unordered: a report older than the known one is ignored. */
  take({ topic, timeMs, counts, reports, recorded }: Diagnostics): void {
    let known = this.#topics.get(topic);
    if (known === undefined) {
      if (this.#topics.size >= MOST_TOPICS) return;
      known = { timeMs, counts, recorded: recorded === true, reports: new Map() };
      this.#topics.set(topic, known);
    }
    if (timeMs >= known.timeMs) Object.assign(known, { timeMs, counts });
    for (const report of reports) {
      const before = known.reports.get(report.name);
      if (before === undefined ? known.reports.size >= MOST_REPORTS : timeMs < before.timeMs) continue;
      known.reports.set(report.name, { report, timeMs });
    }
  }

  /** All components, by topic. */
  list(): ReportedComponents[] {
    return [...this.#topics].map(([topic, { timeMs, counts, recorded, reports }]) => ({
      topic,
      timeMs,
      counts,
      recorded,
      reports: [...reports.values()].map(({ report }) => report).sort(byUrgency),
    }));
  }
}

function byUrgency(a: DiagnosticReport, b: DiagnosticReport): number {
  return diagnosticLevels.indexOf(a.level) - diagnosticLevels.indexOf(b.level) || b.sinceMs - a.sinceMs;
}
