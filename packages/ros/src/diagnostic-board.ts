/** The last report of every node: messages on /diagnostics are partial and come from many nodes. */
import type { DiagnosticLevel, DiagnosticReport } from '@farpoint/protocol';
import type { z } from 'zod';
import { diagnosticArraySchema } from './messages.ts';

/** A node that has reported nothing for this long is stale, ms. */
const STALE_MS = 10_000;
const MOST_NAMES = 1024;
const STALE = 3;
/** By the numbers of diagnostic_msgs/DiagnosticStatus. */
export const DIAGNOSTIC_LEVELS: readonly DiagnosticLevel[] = ['ok', 'warn', 'error', 'stale'];

type Status = z.infer<typeof diagnosticArraySchema>['status'][number];

interface Entry {
  status: Status;
  atMs: number;
  /** The level that it was last seen with, and since when. */
  level: number;
  sinceMs: number;
}

export class DiagnosticBoard {
  readonly #said = new Map<string, Entry>();

  /**
   * Takes in a message.
   *
   * @returns the same message extended by everything reported so far @throws {Error} if the message is invalid
   */
  take(message: unknown, nowMs: number): z.infer<typeof diagnosticArraySchema> {
    const { header, status } = diagnosticArraySchema.parse(message);
    for (const each of status) {
      const before = this.#said.get(each.name);
      if (before === undefined && this.#said.size >= MOST_NAMES) continue;
      if (before !== undefined) this.#age(before, nowMs);
      const level = levelOf(each.level);
      const sinceMs = before?.level === level ? before.sinceMs : nowMs;
      this.#said.set(each.name, { status: each, atMs: nowMs, level, sinceMs });
    }
    for (const entry of this.#said.values()) this.#age(entry, nowMs);
    const all = [...this.#said.values()].map(({ status, level, atMs }) =>
      level === STALE && nowMs - atMs > STALE_MS ? { ...status, level, message: '' } : status,
    );
    return { header, status: all };
  }

  /** Every node's state after the last message, in the order in which they first reported. */
  get components(): DiagnosticReport[] {
    return [...this.#said.values()].map(({ status: { name, message }, level, sinceMs }) => ({
      name,
      message,
      sinceMs,
      level: DIAGNOSTIC_LEVELS[level] ?? 'error',
    }));
  }

  #age(entry: Entry, nowMs: number): void {
    if (nowMs - entry.atMs <= STALE_MS || entry.level === STALE) return;
    entry.level = STALE;
    entry.sinceMs = entry.atMs + STALE_MS;
  }
}

/** A byte in ROS 2, which some libraries represent as text. */
export function levelOf(level: number | string): number {
  const value = typeof level === 'number' ? level : (level.codePointAt(0) ?? 0);
  return Math.min(Math.max(value, 0), STALE);
}
