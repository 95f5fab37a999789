/** Reads which modules a Rust source declares and names: enough to follow its paths, without a Rust compiler. */

/** A name that `use` brings into a module. */
export interface RustImport {
  /** The name inside the module; `*` for a glob. */
  name: string;
  path: string[];
  /** `pub use`, `pub(crate) use`: an alias for others, not a use by this module. */
  exported: boolean;
}

/** A module's content. Inline modules (`mod name { … }`) are separate modules. */
export interface RustModule {
  /** Modules in their own files (`mod name;`). */
  declared: string[];
  inline: Map<string, RustModule>;
  imports: RustImport[];
  /** Paths in code with at least two segments: `crate::rans::encode`, `mask::walk`. */
  paths: string[][];
  /** Every identifier in code, outside `use`. */
  names: Set<string>;
}

/** Parses a source file. Skips items under `#[cfg(test)]`, because tests may use any module. */
export function parseRust(text: string): RustModule {
  return new Parser(tokensOf(text)).module();
}

const BLANKS = [
  /\/\/[^\n]*/, // comments
  /\/\*[\s\S]*?\*\//,
  /b?r(#*)"[\s\S]*?"\1/, // strings
  /b?"(?:\\[\s\S]|[^"\\])*"/,
  /b?'(?:\\(?:x[0-9a-f]{2}|u\{[^}]*\}|.)|[^'\\])'/, // characters; a lifetime has no second quote
];
const BLANK = new RegExp(BLANKS.map(({ source }) => source).join('|'), 'gi');
const TOKEN = /[A-Za-z_]\w*|::|\S/g;
const IDENTIFIER = /^[A-Za-z_]\w*$/;

function tokensOf(text: string): string[] {
  return text.replaceAll(BLANK, ' ').match(TOKEN) ?? [];
}

class Parser {
  private readonly tokens: readonly string[];
  private at = 0;

  constructor(tokens: readonly string[]) {
    this.tokens = tokens;
  }

  /** Parses up to the end, or to the brace that closes an inline module. */
  module(): RustModule {
    const module: RustModule = { declared: [], inline: new Map(), imports: [], paths: [], names: new Set() };
    let depth = 0;
    for (let token = this.next(); token !== undefined; token = this.next()) {
      if (token === '{') depth++;
      else if (token === '}') {
        if (depth === 0) return module;
        depth--;
      } else if (token === '#' && this.peek() === '[') {
        if (this.attribute() === 'cfg(test)') this.skipItem();
      } else if (token === 'mod' && depth === 0) this.submodule(module);
      else if (token === 'use') this.imports(module, depth === 0 && this.isExported());
      else if (IDENTIFIER.test(token)) {
        module.names.add(token);
        if (this.peek() === '::') module.paths.push(this.path(token));
      }
    }
    return module;
  }

  private next(): string | undefined {
    return this.tokens[this.at++];
  }

  private peek(): string | undefined {
    return this.tokens[this.at];
  }

  /** After `#`: the text between the brackets, without blanks. */
  private attribute(): string {
    const start = this.at + 1;
    this.skipBrackets();
    return this.tokens.slice(start, this.at - 1).join('');
  }

  /** Skips an item and its further attributes: up to a semicolon, or over its block. */
  private skipItem(): void {
    for (let token = this.peek(); token !== undefined; token = this.peek()) {
      if ('([{'.includes(token)) this.skipBrackets();
      else this.at++;
      if (token === ';' || token === '{') return;
    }
  }

  /** Skips from an opening bracket to after its closing bracket. */
  private skipBrackets(): void {
    let depth = 0;
    do {
      const token = this.next();
      if (token === undefined) return;
      if ('([{'.includes(token)) depth++;
      else if (')]}'.includes(token)) depth--;
    } while (depth > 0);
  }

  /** After `mod`. */
  private submodule(into: RustModule): void {
    const name = this.next();
    if (name === undefined || !IDENTIFIER.test(name)) return;
    const opening = this.next();
    if (opening === ';') into.declared.push(name);
    else if (opening === '{') into.inline.set(name, this.module());
  }

  /** Called just after `use`: whether `pub` or `pub(…)` precedes it. */
  private isExported(): boolean {
    const before = this.tokens[this.at - 2];
    return (
      before === 'pub' || (before === ')' && this.tokens.slice(this.at - 6, this.at - 2).includes('pub'))
    );
  }

  /** After `use`. */
  private imports(into: RustModule, exported: boolean): void {
    if (this.peek() === '<') return; // `impl Trait + use<'a>`: no import
    for (const { name, path } of this.useTree([])) into.imports.push({ name, path, exported });
  }

  /** `a::b`, `a::b as c`, `a::*`, `a::{b, c}`. */
  private *useTree(prefix: readonly string[]): Generator<{ name: string; path: string[] }> {
    const path = [...prefix];
    do {
      if (this.peek() === '::') this.at++;
      const token = this.next();
      if (token === undefined) return;
      if (token === '{') {
        while (this.peek() !== undefined && this.peek() !== '}') {
          yield* this.useTree(path);
          if (this.peek() === ',') this.at++;
        }
        this.at++;
        return;
      }
      if (token === '*') {
        yield { name: '*', path };
        return;
      }
      // `a::{self}` is a itself.
      if (token !== 'self' || path.length === 0) path.push(token);
    } while (this.peek() === '::');
    let name = path.at(-1) ?? '';
    if (this.peek() === 'as') {
      this.at++;
      name = this.next() ?? '';
    }
    yield { name, path };
  }

  /** A path in code, starting at its first segment. */
  private path(first: string): string[] {
    const path = [first];
    while (this.peek() === '::' && IDENTIFIER.test(this.tokens[this.at + 1] ?? '')) {
      path.push(this.tokens[this.at + 1] ?? '');
      this.at += 2;
    }
    return path;
  }
}
