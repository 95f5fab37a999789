import { type CommandRejected, type CommandRejection, commandRejections } from '@farpoint/protocol';

interface Pending {
  count: number;
  detail: string;
  sequence: number | undefined;
  reportedMs: number;
}

/** Characters of a detail, which the message bounds (packages/protocol). */
const MAX_DETAIL = 512;

/**
 * Reports refusals to one operator, at most ten times a second for each reason: the first at once, later ones combined.
 * A report carries the latest detail and sequence number.
 */
export class RejectionReporter {
  readonly #intervalMs: number;
  readonly #pending = new Map<CommandRejection, Pending>(
    commandRejections.map((reason) => [
      reason,
      { count: 0, detail: '', sequence: undefined, reportedMs: Number.NEGATIVE_INFINITY },
    ]),
  );

  constructor(intervalMs = 100) {
    this.#intervalMs = intervalMs;
  }

  /** @returns the report to send now, or `null` if it must wait (`nextDueMs`) */
  add(
    rejection: { reason: CommandRejection; detail: string },
    sequence: number | undefined,
    nowMs: number,
  ): CommandRejected | null {
    const pending = this.#pending.get(rejection.reason) as Pending;
    pending.count++;
    pending.detail = rejection.detail;
    pending.sequence = sequence;
    return this.#report(rejection.reason, pending, nowMs);
  }

  /** @returns every waiting report that is due now */
  due(nowMs: number): CommandRejected[] {
    const reports: CommandRejected[] = [];
    for (const [reason, pending] of this.#pending) {
      const report = pending.count > 0 ? this.#report(reason, pending, nowMs) : null;
      if (report !== null) reports.push(report);
    }
    return reports;
  }

  /** When `due` has the next report; `null` if none is waiting. */
  get nextDueMs(): number | null {
    let next: number | null = null;
    for (const { count, reportedMs } of this.#pending.values()) {
      if (count > 0) next = Math.min(next ?? Number.POSITIVE_INFINITY, reportedMs + this.#intervalMs);
    }
    return next;
  }

  #report(reason: CommandRejection, pending: Pending, nowMs: number): CommandRejected | null {
    if (nowMs - pending.reportedMs < this.#intervalMs) return null;
    const report: CommandRejected = {
      type: 'rejected',
      ...(pending.sequence === undefined ? {} : { sequence: pending.sequence }),
      reason,
      detail: pending.detail.slice(0, MAX_DETAIL),
      count: pending.count,
    };
    pending.count = 0;
    pending.reportedMs = nowMs;
    return report;
  }
}
