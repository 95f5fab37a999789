/**
 * Reads the elements and attributes of an XML document, as far as robot descriptions need them. Text between the
 * elements is passed over. A document type has no definitions, so nothing can define or load an entity. Its time and its
 * memory are bounded by the length of the document. What common readers of URDF let pass is read as they read it: an
 * unknown reference and a `<` in a value are text.
 */
import { UrdfFault, type UrdfFaultCode } from './urdf-fault.ts';

/** Characters. */
export const MAX_XML_LENGTH = 1 << 20;
const MAX_ELEMENTS = 20_000;
const MAX_DEPTH = 500;
const MAX_ATTRIBUTES = 256;
const ENTITIES: Readonly<Record<string, string>> = { lt: '<', gt: '>', amp: '&', quot: '"', apos: "'" };

const NAME = /[\p{L}_:][\p{L}\p{M}\p{N}_:.·-]{0,127}/uy;
const SPACE = /\s*/y;
const DOCUMENT_TYPE = /!DOCTYPE\b[^<>[\]]*>/iy;
const REFERENCE = /&(?:#(\d{1,7})|#x([0-9A-Fa-f]{1,6})|([a-z]{2,4}));/g;

export interface XmlElement {
  readonly name: string;
  readonly attributes: ReadonlyMap<string, string>;
  readonly children: XmlElement[];
  /** Where it begins, from 1. */
  readonly line: number;
}

/** @returns the root @throws {UrdfFault} */
export function readXml(text: string): XmlElement {
  if (text.length > MAX_XML_LENGTH)
    throw new UrdfFault('too-large', `it has more than ${MAX_XML_LENGTH} characters`);
  return new Reader(text).root();
}

class Reader {
  readonly #text: string;
  #at = 0;
  /** The line of {@link #counted}; counted on from there, so that all lines take one pass. */
  #line = 1;
  #counted = 0;

  constructor(text: string) {
    this.#text = text;
  }

  root(): XmlElement {
    const open: XmlElement[] = [];
    let root: XmlElement | null = null;
    let elements = 0;
    for (let next = this.#nextTag(); next; next = this.#nextTag()) {
      if (this.#text[this.#at] === '/') {
        this.#close(open.pop());
        continue;
      }
      const [element, isEmpty] = this.#element();
      if (++elements > MAX_ELEMENTS)
        throw this.#fault(`there are more than ${MAX_ELEMENTS} elements`, 'too-many');
      if (open.length >= MAX_DEPTH)
        throw this.#fault(`elements are nested more than ${MAX_DEPTH} deep`, 'too-many');
      const parent = open.at(-1);
      if (parent !== undefined) parent.children.push(element);
      else if (root === null) root = element;
      else throw this.#fault(`<${element.name}> stands beside the root`);
      if (!isEmpty) open.push(element);
    }
    const left = open.at(-1);
    if (left !== undefined) throw this.#fault(`<${left.name}> of line ${left.line} is not closed`);
    if (root === null) throw this.#fault('there is no element');
    return root;
  }

  /** Goes behind the next `<` of an element. @returns whether there is one */
  #nextTag(): boolean {
    const text = this.#text;
    for (;;) {
      const at = text.indexOf('<', this.#at);
      if (at < 0) return false;
      this.#at = at + 1;
      if (text.startsWith('!--', this.#at)) this.#skip('-->');
      else if (text.startsWith('![CDATA[', this.#at)) this.#skip(']]>');
      else if (text[this.#at] === '?') this.#skip('?>');
      else if (text[this.#at] === '!') this.#documentType();
      else return true;
    }
  }

  #skip(end: string): void {
    const at = this.#text.indexOf(end, this.#at);
    if (at < 0) throw this.#fault(`${end} is missing`);
    this.#at = at + end.length;
  }

  #documentType(): void {
    if (this.#match(DOCUMENT_TYPE) === '')
      throw this.#fault('its document type defines something', 'doctype');
  }

  #element(): [element: XmlElement, isEmpty: boolean] {
    const name = this.#name();
    const line = this.#lineAt();
    const attributes = new Map<string, string>();
    for (;;) {
      this.#match(SPACE);
      if (this.#take('>')) return [{ name, attributes, children: [], line }, false];
      if (this.#take('/>')) return [{ name, attributes, children: [], line }, true];
      const key = this.#match(NAME);
      if (key === '') throw this.#fault(`the tag <${name} is not well-formed`);
      this.#match(SPACE);
      if (!this.#take('=')) throw this.#fault(`the attribute ${key} has no value`);
      this.#match(SPACE);
      if (attributes.has(key)) throw this.#fault(`the attribute ${key} is there twice`);
      attributes.set(key, this.#value(key));
      if (attributes.size > MAX_ATTRIBUTES)
        throw this.#fault(`an element has more than ${MAX_ATTRIBUTES} attributes`, 'too-many');
    }
  }

  #value(key: string): string {
    const quote = this.#text[this.#at];
    if (quote !== '"' && quote !== "'") throw this.#fault(`the value of ${key} is not quoted`);
    const end = this.#text.indexOf(quote, this.#at + 1);
    if (end < 0) throw this.#fault(`the value of ${key} does not end`);
    const raw = this.#text.slice(this.#at + 1, end);
    this.#at = end + 1;
    return raw.includes('&') ? unescaped(raw) : raw;
  }

  #close(open: XmlElement | undefined): void {
    this.#at++;
    const name = this.#name();
    this.#match(SPACE);
    if (!this.#take('>')) throw this.#fault(`the tag </${name} is not well-formed`);
    if (open === undefined) throw this.#fault(`</${name}> closes nothing`);
    if (open.name !== name) throw this.#fault(`</${name}> closes <${open.name}> of line ${open.line}`);
  }

  #name(): string {
    const name = this.#match(NAME);
    if (name === '') throw this.#fault('a name is expected');
    return name;
  }

  #match(pattern: RegExp): string {
    pattern.lastIndex = this.#at;
    const [found = ''] = pattern.exec(this.#text) ?? [];
    this.#at += found.length;
    return found;
  }

  #take(word: string): boolean {
    if (!this.#text.startsWith(word, this.#at)) return false;
    this.#at += word.length;
    return true;
  }

  #lineAt(): number {
    const until = Math.min(this.#at, this.#text.length);
    for (let i = this.#counted; i < until; i++) if (this.#text.charCodeAt(i) === 10) this.#line++;
    this.#counted = Math.max(this.#counted, until);
    return this.#line;
  }

  #fault(detail: string, code: UrdfFaultCode = 'not-xml'): UrdfFault {
    return new UrdfFault(code, detail, this.#lineAt());
  }
}

function unescaped(raw: string): string {
  return raw.replace(REFERENCE, (whole, decimal?: string, hex?: string, named?: string) => {
    const code = decimal !== undefined ? Number(decimal) : Number.parseInt(hex ?? '', 16);
    const known = named !== undefined && Object.hasOwn(ENTITIES, named) ? ENTITIES[named] : undefined;
    return known ?? (code > 0 && code <= 0x10ffff ? String.fromCodePoint(code) : whole);
  });
}
