import { describe, expect, test } from 'vitest';
import { rustFileGraph } from './rust-modules.ts';

/** A crate's graph as plain arrays. */
function graphOf(sources: Record<string, string>): Record<string, string[]> {
  const graph = rustFileGraph(new Map(Object.entries(sources)));
  return Object.fromEntries([...graph].map(([file, targets]) => [file, [...targets].sort()]));
}

describe('rustFileGraph', () => {
  test('follows crate, super and self to the files that define what they name', () => {
    const graph = graphOf({
      'lib.rs': 'mod a;\nmod b;\npub type Point = [f32; 4];',
      'a.rs': 'use crate::Point;\nuse super::b::Item as Other;',
      'b/mod.rs': 'mod inner;\npub struct Item;\nuse self::inner::Hidden;',
      'b/inner.rs': 'use super::super::a::Thing;\npub struct Hidden;',
    });
    expect(graph).toEqual({
      'lib.rs': [],
      'a.rs': ['b/mod.rs', 'lib.rs'],
      'b/mod.rs': ['b/inner.rs'],
      'b/inner.rs': ['a.rs'],
    });
  });

  test('sees through nested braces, globs and self', () => {
    const graph = graphOf({
      'lib.rs': '',
      'a.rs': 'use crate::{b::{self, One, c::{Two, Three}}, d::*};',
      'b/mod.rs': 'pub struct One;',
      'b/c.rs': '',
      'd.rs': '',
    });
    expect(graph['a.rs']).toEqual(['b/c.rs', 'b/mod.rs', 'd.rs']);
  });

  test('treats a re-export as an alias of what it names', () => {
    const graph = graphOf({
      'lib.rs': 'mod rans;\npub(crate) use rans::Coder;',
      'rans/mod.rs': 'mod coder;\npub use coder::Coder;\npub const TOTAL: u32 = 1;',
      'rans/coder.rs': 'use super::TOTAL;\npub struct Coder;',
      'user.rs': 'use crate::Coder;',
    });
    expect(graph).toEqual({
      'lib.rs': [],
      'rans/mod.rs': [],
      'rans/coder.rs': ['rans/mod.rs'],
      'user.rs': ['rans/coder.rs'],
    });
  });

  test('counts a re-export that its own file uses', () => {
    const graph = graphOf({
      'lib.rs': 'mod coder;\npub use coder::Coder;\npub fn f() -> Coder { todo!() }',
      'coder.rs': 'pub struct Coder;',
    });
    expect(graph['lib.rs']).toEqual(['coder.rs']);
  });

  test('counts paths in code that start at child or imported modules', () => {
    const graph = graphOf({
      'main.rs': 'mod a;\nmod b;\nfn main() { a::run(); crate::c::stop(); std::process::exit(0) }',
      'a.rs': 'use crate::b;\npub fn run() { b::go() }',
      'b.rs': 'pub use crate::c::go;',
      'c.rs': '',
    });
    expect(graph['main.rs']).toEqual(['a.rs', 'c.rs']);
    expect(graph['a.rs']).toEqual(['b.rs', 'c.rs']);
  });

  test('follows all of several imports with the same name', () => {
    const graph = graphOf({
      'lib.rs':
        '#[cfg(unix)]\nuse one as system;\n#[cfg(windows)]\nuse two as system;\nfn f() { system::g() }',
      'one.rs': '',
      'two.rs': '',
    });
    expect(graph['lib.rs']).toEqual(['one.rs', 'two.rs']);
  });

  test('ignores tests, comments, strings and other crates', () => {
    const graph = graphOf({
      'lib.rs': '',
      'a.rs': [
        'use wide::i16x8; // use crate::b;',
        '/* use crate::b; */ /// [`crate::b`]',
        'const TEXT: &str = "use crate::b;";',
        "const QUOTE: char = '\"';",
        "fn f<'a>(x: &'a str) -> impl Iterator + use<'a> { r#\"crate::b\"# }",
        '#[cfg(test)]',
        '#[allow(dead_code)]',
        'mod tests { use super::*; use crate::b; fn g() { if true {} } }',
        '#[cfg(test)]',
        'use crate::b;',
      ].join('\n'),
      'b.rs': '',
    });
    expect(graph['a.rs']).toEqual([]);
  });

  test('treats an inline module as part of its file', () => {
    const graph = graphOf({
      'lib.rs': '',
      'a.rs': 'mod inner { use super::Own; use super::super::b::Other; }\nstruct Own;',
      'b.rs': '',
    });
    expect(graph['a.rs']).toEqual(['b.rs']);
  });
});
