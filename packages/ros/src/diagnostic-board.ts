/** The last report of every node: messages on /diagnostics are partial and come from many nodes. */
import type { z } from 'zod';
import { diagnosticArraySchema } from './messages.ts';

/** A node that has reported nothing for this long is stale, ms. */
const STALE_MS = 10_000;
const MOST_NAMES = 1024;
const STALE = 3;

type Status = z.infer<typeof diagnosticArraySchema>['status'][number];

export class DiagnosticBoard {
  readonly #said = new Map<string, { status: Status; atMs: number }>();

  /**
   * Takes in a message.
   *
   * @returns the same message extended by everything reported so far @throws {Error} if the message is invalid
   */
  take(message: unknown, nowMs: number): z.infer<typeof diagnosticArraySchema> {
    const { header, status } = diagnosticArraySchema.parse(message);
    for (const each of status) {
      if (this.#said.has(each.name) || this.#said.size < MOST_NAMES) {
        this.#said.set(each.name, { status: each, atMs: nowMs });
      }
    }
    const all = [...this.#said.values()].map(({ status, atMs }) =>
      nowMs - atMs > STALE_MS ? { ...status, level: STALE, message: '' } : status,
    );
    return { header, status: all };
  }
}
