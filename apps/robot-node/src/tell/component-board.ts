/** Reports of the robot's components that wait to be sent: those that have changed first, the others in turn. */
import {
  DIAGNOSTICS_LIMITS,
  type DiagnosticReport,
  type Diagnostics,
  diagnosticLevels,
} from '@farpoint/protocol';
import { shortened } from '@farpoint/ros';

/**
 * A topic without news is sent again after this long: an operator may have connected since, ms. Chosen: twice
 * the second in which ROS' diagnostics come.
 */
const REPEAT_MS = 2000;

interface Entry {
  report: DiagnosticReport;
  told: number;
  changed: boolean;
}

interface Topic {
  timeMs: number;
  toldMs: number;
  readonly recorded: boolean;
  readonly entries: Map<string, Entry>;
}

export class ComponentBoard {
  readonly #topics = new Map<string, Topic>();
  #told = 0;

  /**
   * @param reports of all components of the topic
   * @param timeMs when the newest came, robot's clock
   * @param recorded whether they come from a recording that is played
   */
  take(topic: string, reports: readonly DiagnosticReport[], timeMs: number, recorded = false): void {
    const toldMs = Number.NEGATIVE_INFINITY;
    const known = this.#topics.get(topic) ?? { timeMs, toldMs, recorded, entries: new Map() };
    this.#topics.set(topic, known);
    known.timeMs = timeMs;
    for (const report of reports) {
      const before = known.entries.get(report.name);
      const { level, message } = before?.report ?? {};
      const changed = before?.changed === true || level !== report.level || message !== report.message;
      known.entries.set(report.name, { report, told: before?.told ?? 0, changed });
    }
  }

  /** The next message; `null` if there is nothing to say now. */
  next(nowMs: number): Diagnostics | null {
    let due: [string, Topic] | null = null;
    for (const [name, topic] of this.#topics) {
      const isNew = topic.timeMs > topic.toldMs || nowMs - topic.toldMs >= REPEAT_MS;
      if (isNew && (due === null || topic.toldMs < due[1].toldMs)) due = [name, topic];
    }
    if (due === null) return null;
    const [topic, { timeMs, entries, recorded }] = due;
    due[1].toldMs = nowMs;
    const counts = { error: 0, warn: 0, stale: 0, ok: 0 };
    for (const { report } of entries.values()) counts[report.level]++;
    const first = [...entries.values()].sort(byUrgency).slice(0, DIAGNOSTICS_LIMITS.reports);
    const reports = first.map((entry) => {
      entry.changed = false;
      entry.told = ++this.#told;
      return told(entry.report);
    });
    const mark = recorded ? { recorded: true as const } : {};
    return { type: 'diagnostics', topic, timeMs, counts, reports, ...mark };
  }
}

function byUrgency(a: Entry, b: Entry): number {
  if (a.changed !== b.changed) return a.changed ? -1 : 1;
  const urgency = diagnosticLevels.indexOf(a.report.level) - diagnosticLevels.indexOf(b.report.level);
  return a.changed && urgency !== 0 ? urgency : a.told - b.told;
}

function told({ name, level, message, sinceMs }: DiagnosticReport): DiagnosticReport {
  const { name: mostName, message: mostMessage } = DIAGNOSTICS_LIMITS;
  return { name: shortened(name, mostName), level, message: shortened(message, mostMessage), sinceMs };
}
