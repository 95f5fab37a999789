/** What every node has last said of itself: /diagnostics comes in parts, from many. */
import type { z } from 'zod';
import { diagnosticArraySchema } from './messages.ts';

/** A node that has said nothing for so long is stale, ms. */
const STALE_MS = 10_000;
const MOST_NAMES = 1024;
const STALE = 3;

type Status = z.infer<typeof diagnosticArraySchema>['status'][number];

export class DiagnosticBoard {
  readonly #said = new Map<string, { status: Status; atMs: number }>();

  /** @returns the same message with everything that was said so far @throws {Error} where the message is none */
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
