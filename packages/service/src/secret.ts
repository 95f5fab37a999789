import { inspect } from 'node:util';

const SHOWN = '[secret]';

/** A text that no log, message or stack shows, however it gets there. */
export class Secret {
  readonly #text: string;

  constructor(text: string) {
    this.#text = text;
  }

  /** The text itself. Call it only where it is used. */
  reveal(): string {
    return this.#text;
  }

  toString(): string {
    return SHOWN;
  }

  toJSON(): string {
    return SHOWN;
  }

  [inspect.custom](): string {
    return SHOWN;
  }
}

/** User name and password in a URL (RFC 3986, 3.2.1), in text or in JSON. The last `@` before the path ends them. */
const USER_INFO = /(\/\/)[^/?#\s"'\\<>]*@/g;
/** Parameters of a query that are as good as a password. */
const QUERY = /([?&](?:[a-z_-]*token|api_?key|key|password|passwd|pwd|secret|credential)=)[^&#\s"'\\<>]+/gi;

/** A text, whose URLs are shown without user names, passwords and tokens. */
export function withoutCredentials(text: string): string {
  if (!text.includes('//') && !text.includes('=')) return text;
  return text.replaceAll(USER_INFO, '$1…@').replaceAll(QUERY, '$1…');
}
