/** Verifies that nobody has changed, removed, reordered or inserted an entry. */
import * as z from 'zod';
import { type AuditEntry, MAX_LINE_BYTES, NO_PREVIOUS, readEntry } from './audit-entry.ts';
import { Fragment } from './fragment.ts';

/** What is wrong with a chain. */
export type ChainFaultKind =
  | 'changed' // the entry is not what was written
  | 'missing' // it is not there
  | 'reordered' // it comes later
  | 'inserted' // something is there that does not belong to the chain
  | 'torn' // the last line is incomplete
  | 'empty'; // there is no entry

export interface Place {
  readonly file: string;
  /** From 1. */
  readonly line: number;
}

export interface ChainFault {
  readonly kind: ChainFaultKind;
  /** Number of the first entry concerned. */
  readonly entry: number;
  readonly place: Place;
  /** One sentence. */
  readonly detail: string;
}

/** A chain without a fault. */
export interface VerifiedChain {
  readonly first: AuditEntry;
  readonly last: AuditEntry;
  readonly entries: number;
  /** Entries that were lost when the program ended while it wrote, as the log itself says. */
  readonly torn: number;
  /** Whether an entry has the hash that was asked for; null if none was. */
  readonly containsExpected: boolean | null;
}

export interface ChainVerifierOptions {
  /** Whether the chain may begin after its first entry, because older files are elsewhere. */
  readonly partial?: boolean;
  /** Hash of an entry that the chain must contain, which shows that nothing up to it was cut off. */
  readonly expected?: string | undefined;
}

const tornSchema = z.object({ bytes: z.int().min(1), sha256: z.string() });

/** Takes the bytes of one file after the other, oldest first. Its memory does not grow with them. */
export class ChainVerifier {
  readonly #options: ChainVerifierOptions;
  #place: { file: string; line: number } = { file: '', line: 1 };
  #partialLine: Uint8Array[] = [];
  #partialBytes = 0;
  /** Lines since the last entry that are no entries. */
  #fragment: { bytes: Fragment; place: Place } | null = null;
  #first: AuditEntry | null = null;
  #last: { entry: AuditEntry; place: Place } | null = null;
  #entries = 0;
  #torn = 0;
  #foundExpected = false;
  #fault: ChainFault | null = null;

  constructor(options: ChainVerifierOptions = {}) {
    this.#options = options;
  }

  /** The next bytes are of another file. */
  beginFile(file: string): void {
    if (this.#partialBytes > 0) this.#endLine();
    this.#place = { file, line: 1 };
  }

  push(bytes: Uint8Array): void {
    let from = 0;
    for (let at = bytes.indexOf(0x0a); at !== -1; at = bytes.indexOf(0x0a, from)) {
      this.#addToLine(bytes.subarray(from, at));
      this.#endLine();
      from = at + 1;
    }
    this.#addToLine(bytes.subarray(from));
  }

  /** @returns the first fault, if there is one */
  end(): VerifiedChain | ChainFault {
    const whole = this.#partialBytes === 0;
    if (!whole) this.#endLine();
    if (this.#fault !== null) return this.#fault;
    const place = this.#fragment?.place ?? { ...this.#place };
    const entry = this.#expectedSequence ?? 0;
    if (this.#fragment !== null) {
      return whole
        ? { kind: 'changed', entry, place, detail: `entry ${entry} is not what was written` }
        : {
            kind: 'torn',
            entry,
            place,
            detail: `entry ${entry} is incomplete: the program ended while it wrote it, or it was changed`,
          };
    }
    if (this.#first === null || this.#last === null)
      return { kind: 'empty', entry: 0, place, detail: 'there is no entry' };
    const { expected } = this.#options;
    return {
      first: this.#first,
      last: this.#last.entry,
      entries: this.#entries,
      torn: this.#torn,
      containsExpected: expected === undefined ? null : this.#foundExpected,
    };
  }

  get #expectedSequence(): number | null {
    return this.#last === null ? null : this.#last.entry.sequence + 1;
  }

  #addToLine(bytes: Uint8Array): void {
    if (bytes.byteLength === 0) return;
    this.#partialBytes += bytes.byteLength;
    this.#partialLine.push(bytes.slice());
    // Too long for an entry, so it is not kept.
    if (this.#partialBytes > MAX_LINE_BYTES) this.#addToFragment();
  }

  #endLine(): void {
    const place = { ...this.#place };
    this.#place.line++;
    const long = this.#partialBytes > MAX_LINE_BYTES;
    const entry = long ? null : readEntry(Buffer.concat(this.#partialLine));
    if (entry === null) {
      this.#addToFragment(place);
      this.#fragment?.bytes.endLine();
    } else {
      this.#onEntry(entry, place);
    }
    this.#partialLine = [];
    this.#partialBytes = 0;
  }

  #addToFragment(place: Place = { ...this.#place }): void {
    this.#fragment ??= { bytes: new Fragment(), place };
    for (const bytes of this.#partialLine) this.#fragment.bytes.add(bytes);
    this.#partialLine = [];
  }

  #onEntry(entry: AuditEntry, place: Place): void {
    if (this.#fault !== null) {
      // Whether an entry is missing or only in the wrong place shows later.
      if (this.#fault.kind === 'missing' && entry.sequence === this.#fault.entry) {
        const detail = `entry ${entry.sequence} is in another place: line ${place.line} of ${place.file}`;
        this.#fault = { ...this.#fault, kind: 'reordered', detail };
      }
      return;
    }
    this.#fault = this.#faultOf(entry, place);
    this.#fragment = null;
    if (this.#fault !== null) return;
    if (entry.kind === 'torn-entry') this.#torn++;
    if (entry.hash === this.#options.expected) this.#foundExpected = true;
    this.#first ??= entry;
    this.#last = { entry, place };
    this.#entries++;
  }

  #faultOf(entry: AuditEntry, place: Place): ChainFault | null {
    const { sequence } = entry;
    const expected = this.#expectedSequence ?? (this.#options.partial ? sequence : 0);
    const previous =
      this.#last?.entry.hash ?? (this.#options.partial && sequence > 0 ? entry.previous : NO_PREVIOUS);
    const follows = sequence === expected && entry.previous === previous;
    const torn = entry.kind === 'torn-entry' ? tornSchema.safeParse(entry.details) : null;
    if (this.#fragment !== null) {
      if (follows && torn?.success && this.#fragment.bytes.is(torn.data)) return null;
      const where = { entry: expected, place: this.#fragment.place };
      // Nothing says what was there: an entry, or something that was added.
      if (this.#last === null && expected > 0) {
        const detail = `what is before entry ${expected} is not what was written`;
        return { kind: 'changed', ...where, entry: expected - 1, detail };
      }
      return follows
        ? { kind: 'inserted', ...where, detail: `what is before entry ${expected} is no entry of this log` }
        : { kind: 'changed', ...where, detail: `entry ${expected} is not what was written` };
    }
    if (follows) {
      if (torn === null) return null;
      const detail = `what entry ${sequence} says about the bytes before it is not so: they are missing`;
      return { kind: 'missing', entry: sequence, place, detail };
    }
    if (sequence > expected) {
      const upTo = sequence - 1 === expected ? '' : `–${sequence - 1}`;
      const detail = `entry ${expected}${upTo} is missing before entry ${sequence}`;
      return { kind: 'missing', entry: expected, place, detail };
    }
    if (sequence < expected)
      return {
        kind: 'inserted',
        entry: sequence,
        place,
        detail: `a second entry ${sequence} comes after entry ${expected - 1}`,
      };
    const changed = this.#last ?? { entry, place };
    const detail =
      this.#last === null
        ? 'entry 0 does not begin a chain'
        : `entry ${changed.entry.sequence} was replaced: entry ${sequence} does not follow it`;
    return { kind: 'changed', entry: changed.entry.sequence, place: changed.place, detail };
  }
}
