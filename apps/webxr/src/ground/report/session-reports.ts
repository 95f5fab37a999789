/** The reports of this tab's sessions, the newest first. Pure: time is passed in. */
import { type ReadonlySignal, signal } from '@preact/signals-core';
import * as z from 'zod/mini';
import { reportSchema, type SessionReport } from './report-schema.ts';
import { SessionRecord, type SessionStart } from './session-record.ts';

/** Older ones are dropped. Chosen: the sessions of a working day; session-reports.test.ts holds it. */
export const MOST_REPORTS = 20;

const keptSchema = z.array(reportSchema).check(z.maxLength(MOST_REPORTS));

export class SessionReports {
  /** The session that lasts; `null` without one. */
  current: SessionRecord | null = null;
  readonly #ended = signal<readonly SessionReport[]>([]);

  /** Those that are over. */
  get ended(): ReadonlySignal<readonly SessionReport[]> {
    return this.#ended;
  }

  /** A session begins; one that lasts is over. */
  begin(start: SessionStart): void {
    this.end('new-session', start.nowMs);
    this.current = new SessionRecord(start);
  }

  end(reason: string, nowMs: number): void {
    const { current } = this;
    if (current === null) return;
    this.current = null;
    current.end(reason, nowMs);
    this.#keep([current.report(nowMs), ...this.#ended.peek()]);
  }

  /** All, also of the session that lasts. */
  all(nowMs: number): readonly SessionReport[] {
    const { current } = this;
    return current === null ? this.#ended.peek() : [current.report(nowMs), ...this.#ended.peek()];
  }

  /** Takes back what {@link text} was; nothing if it is anything else. */
  restore(text: string | null): void {
    try {
      const { success, data } = keptSchema.safeParse(JSON.parse(text ?? 'null'));
      if (success) this.#keep([...this.#ended.peek(), ...data]);
    } catch {
      // It is no JSON.
    }
  }

  /** What a tab keeps. @param reason why a session that lasts will be over */
  text(reason: string, nowMs: number): string {
    const [newest, ...others] = this.all(nowMs);
    if (newest === undefined) return '[]';
    const ended =
      newest.end === null
        ? { ...newest, end: reason, endedMs: newest.beganMs + newest.durationS * 1000 }
        : newest;
    return JSON.stringify([ended, ...others].slice(0, MOST_REPORTS));
  }

  #keep(reports: readonly SessionReport[]): void {
    this.#ended.value = reports.slice(0, MOST_REPORTS);
  }
}
