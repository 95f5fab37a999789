import { type ChatLine, KEPT_CHAT_LINES, type NamedOperator } from '@farpoint/protocol';

/** A line, as it was said. */
export interface SaidLine {
  readonly number: number;
  /** The session that said it. */
  readonly session: string;
  readonly from: NamedOperator;
  readonly text: string;
  readonly saidMs: number;
}

/** Keeps the last lines that operators have said. Pure: time is an argument. */
export class ChatRoom {
  readonly #lines: SaidLine[] = [];
  #lastNumber = 0;

  /** The oldest first. */
  get lines(): readonly SaidLine[] {
    return this.#lines;
  }

  say(session: string, from: NamedOperator, text: string, nowMs: number): SaidLine {
    this.#lastNumber = (this.#lastNumber + 1) >>> 0;
    const line = { number: this.#lastNumber, session, from, text, saidMs: nowMs };
    this.#lines.push(line);
    if (this.#lines.length > KEPT_CHAT_LINES) this.#lines.shift();
    return line;
  }
}

/** The line as this session is told it. */
export function chatLineFor(session: string, line: SaidLine, nowMs: number): ChatLine {
  const { number, from, text, saidMs } = line;
  const agoS = Math.max(0, Math.floor((nowMs - saidMs) / 1000));
  return { type: 'chatLine', number, from, yours: line.session === session, text, agoS };
}
