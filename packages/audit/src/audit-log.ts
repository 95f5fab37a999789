import { CHAIN_START, type ChainEnd, makeEntry } from './audit-entry.ts';
import type { AuditEvent } from './audit-event.ts';
import { AuditFile, type OpenedLog } from './audit-file.ts';
import { EntryLimiter } from './entry-limiter.ts';

/** Events that wait for the disk. When there are more, the oldest are dropped. */
const MOST_WAITING = 1024;
/** After a failed write, the time until the next attempt, ms. */
const RETRY_MS = 5000;
/** How long counts of omitted entries are collected before they are written, ms. */
const OMITTED_MS = 10_000;

/** Where a program reports what is recorded. */
export interface Audit {
  /** Never throws and never waits. */
  record(event: AuditEvent): void;
}

/** For programs without an audit log. */
export const noAudit: Audit = { record: () => undefined };

export interface AuditLogOptions {
  readonly path: string;
  /** A file of this size is renamed, and a new one begins, bytes. */
  readonly maxBytes: number;
  /** The robot whose log it is; absent if each event names its own. */
  readonly robot?: string | undefined;
  /** ms since 1970. */
  readonly nowMs: () => number;
  /** A monotonic clock, ms. */
  readonly clockMs: () => number;
  /** Writing has failed (an error), or works again (null). The program goes on in either case. */
  readonly onFault: (error: Error | null) => void;
  /** Something has been found in the file that this program did not leave there in order. */
  readonly onDamage: (damage: Damage) => void;
}

export type Damage =
  | { readonly kind: 'torn'; readonly bytes: number }
  | { readonly kind: 'set-aside'; readonly file: string; readonly bytes: number };

interface Waiting {
  readonly event: AuditEvent;
  readonly timeMs: number;
}

/** Faults of a disk. A robot starts nevertheless, and tries again. */
const DISK_FAULTS: ReadonlySet<string | undefined> = new Set(['ENOSPC', 'EDQUOT', 'EIO', 'EROFS']);

/** Writes events to the file, in order, without ever holding up the program. */
export class AuditLog implements Audit {
  readonly #options: AuditLogOptions;
  readonly #limiter = new EntryLimiter();
  /** Null if it could not be opened yet. */
  #file: AuditFile | null = null;
  #end: ChainEnd = CHAIN_START;
  /** What must be written first, about what was found in the file. */
  #notes: Waiting[] = [];
  #waiting: Waiting[] = [];
  #dropped = 0;
  /** What the last write began with, and the chain's end after each entry, until it has succeeded. */
  #attempt: { readonly batch: readonly Waiting[]; readonly ends: readonly ChainEnd[] } | null = null;
  #writing: Promise<void> | null = null;
  #failed = false;
  #closed = false;
  #retry: NodeJS.Timeout | null = null;
  #reportOmitted: NodeJS.Timeout | null = null;

  private constructor(options: AuditLogOptions) {
    this.#options = options;
  }

  /**
   * A disk that is full or broken is a fault like any later one.
   *
   * @throws {AuditFileError} if the path leads to something that is no file; a system error if it cannot be opened
   */
  static async open(options: AuditLogOptions): Promise<AuditLog> {
    const log = new AuditLog(options);
    try {
      await log.#reopen();
    } catch (error) {
      if (!DISK_FAULTS.has((error as NodeJS.ErrnoException).code)) throw error;
      log.#fail(error as Error);
    }
    return log;
  }

  record(event: AuditEvent): void {
    if (this.#closed) return;
    if (this.#limiter.admits(event, this.#options.clockMs())) {
      this.#add(event);
      return;
    }
    this.#reportOmitted ??= setTimeout(() => {
      this.#reportOmitted = null;
      this.#addOmitted();
    }, OMITTED_MS).unref();
  }

  /** Writes what waits, tries that once, and closes the file. Never throws. */
  async close(): Promise<void> {
    if (this.#closed) return;
    this.#addOmitted();
    this.#closed = true;
    for (const timer of [this.#reportOmitted, this.#retry]) if (timer !== null) clearTimeout(timer);
    await this.#writing;
    // What was recorded during the last write, or after a write that failed.
    if (this.#waiting.length > 0 || this.#notes.length > 0) await this.#write();
    await this.#file?.close().catch(() => undefined);
  }

  #addOmitted(): void {
    const omitted = this.#limiter.takeOmitted();
    if (omitted !== null) this.#add({ kind: 'entries-omitted', details: omitted });
  }

  #add(event: AuditEvent): void {
    if (this.#waiting.length >= MOST_WAITING) {
      this.#waiting.shift();
      this.#dropped++;
    }
    this.#waiting.push({ event, timeMs: this.#options.nowMs() });
    this.#pump();
  }

  #pump(): void {
    if (this.#writing !== null || this.#retry !== null || this.#closed) return;
    this.#writing = this.#write().finally(() => {
      this.#writing = null;
      if (this.#waiting.length > 0) this.#pump();
    });
  }

  /** Writes what waits. Never throws. */
  async #write(): Promise<void> {
    // Events that are recorded at the same moment share one write, and one wait for the disk.
    await Promise.resolve();
    try {
      if (this.#file === null || !(await this.#file.isCurrent())) await this.#reopen();
      if (this.#file !== null) await this.#writeBatch(this.#file);
    } catch (error) {
      this.#fail(error as Error);
      return;
    }
    if (this.#failed) this.#options.onFault(null);
    this.#failed = false;
  }

  #fail(error: Error): void {
    if (!this.#failed) this.#options.onFault(error);
    this.#failed = true;
    if (this.#closed) return;
    this.#retry = setTimeout(() => {
      this.#retry = null;
      this.#pump();
    }, RETRY_MS).unref();
  }

  async #writeBatch(file: AuditFile): Promise<void> {
    const { robot, nowMs } = this.#options;
    const dropped = this.#dropped;
    const event: AuditEvent = { kind: 'entries-dropped', details: { count: dropped } };
    const gap: Waiting[] = dropped === 0 ? [] : [{ event, timeMs: nowMs() }];
    const batch = [...this.#notes, ...gap, ...this.#waiting];
    const ends: ChainEnd[] = [];
    let text = '';
    for (const { event, timeMs } of batch) {
      const from = ends.at(-1) ?? this.#end;
      const made = makeEntry(from, robot === undefined ? event : { robot, ...event }, timeMs);
      text += made.line;
      ends.push(made.end);
    }
    if (file.isFull(Buffer.byteLength(text))) await file.rotate(this.#end);
    this.#attempt = { batch, ends };
    await file.append(text);
    this.#attempt = null;
    this.#end = ends.at(-1) ?? this.#end;
    this.#written(batch);
    this.#dropped -= dropped;
  }

  /** Meanwhile, others may have been added, and some dropped. */
  #written(batch: readonly Waiting[]): void {
    const done = new Set(batch);
    this.#notes = this.#notes.filter((waiting) => !done.has(waiting));
    this.#waiting = this.#waiting.filter((waiting) => !done.has(waiting));
  }

  /** At the start; or the file was moved away or written to by somebody else; or a write has failed half-way. */
  async #reopen(): Promise<void> {
    const { file, found } = await AuditFile.open(this.#options.path, this.#options.maxBytes);
    await this.#file?.close().catch(() => undefined);
    this.#file = file;
    const { attempt, end } = { attempt: this.#attempt, end: this.#end };
    this.#attempt = null;
    // Entries of a failed write that are in the file nevertheless.
    const whole = attempt?.ends.findIndex(({ previous }) => previous === found.end.previous) ?? -1;
    if (attempt !== null && whole >= 0) this.#written(attempt.batch.slice(0, whole + 1));
    // A file that was moved away takes its end with it, but the chain goes on.
    this.#end = found.end.sequence < end.sequence ? end : found.end;
    this.#noteDamage(found);
  }

  #noteDamage({ torn, setAside }: OpenedLog): void {
    const { onDamage, nowMs } = this.#options;
    const note = (event: AuditEvent) => this.#notes.unshift({ event, timeMs: nowMs() });
    // What an earlier note says about the end of the file is no longer so.
    this.#notes = this.#notes.filter(({ event }) => event.kind !== 'torn-entry');
    if (torn !== null) {
      onDamage({ kind: 'torn', bytes: torn.bytes });
      note({ kind: 'torn-entry', details: { ...torn } });
    }
    if (setAside !== null) {
      onDamage({ kind: 'set-aside', ...setAside });
      note({ kind: 'log-set-aside', details: { ...setAside } });
    }
  }
}
