/** Compares the table of dependencies in docs/architecture.md with what the sources import. */
import { dirname } from 'node:path';
import { describe, expect, test } from 'vitest';
import { cycles } from './lib/cycles.ts';
import { importedFiles, startedFiles } from './lib/file-imports.ts';
import { importedPackages, repeatedImports } from './lib/package-imports.ts';
import { allowedFolders, parseRooms } from './lib/rooms.ts';
import { workspaceFiles as files, readWorkspaceFile as read } from './lib/workspace-files.ts';

const MAX_LINES = 400;
/** Tests of what reads imports have imports as their input. */
const NAMES_WHAT_IS_NOT = /^scripts\/lib\/(?:file-imports|import-graph)\.test\.ts$/;
/** What is shorter stands beside its user. */
const LEAST_LINES = 15;
/** Sources of what is installed, or runs in a page. */
const PRODUCTION = /^(?:(?:apps|packages)\/[^/]+|wasm-codec)\/src\//;
/** A constant of a file that is a number, or numbers. What follows from other constants needs no word. */
const NUMBER = /^(?:export )?const (\[[A-Z\d_, ]+\]|[A-Z][A-Z\d_]*)(?:: [\w ]+)? = [-([]*\d/;
/** Units of docs/style.md and quantities without any; `NS_PER_MS` and `TICKS_PER_MS` convert, and `PER_SECOND` is a rate. */
const WITH_UNIT =
  /^(?!.*_PER_MS).*_(?:MS|S|M|MPS|RAD|RADPS|HZ|PX|BYTES|PER_S|PER_SECOND|SHARE|FACTOR|MARGIN|FRAMES|PACKETS|POINTS|SAMPLES)(?:[,\]]|$)/;
const COMMENT_ENDS = /\*\/$|^\/\//;
const DEVELOPERS = /\.test\.ts$|\/(?:testing|deploy|vectors)\/|(?:\.config|\/build)\.ts$/;

const rooms = parseRooms(read('docs/architecture.md')).filter(({ folder }) => !folder.includes('/src/'));
const manifests = files.filter((file) =>
  /^(?:(?:packages|apps|tools)\/[^/]+|wasm-codec|e2e|bench)\/package\.json$/.test(file),
);
const folders = manifests.map((file) => dirname(file));
const folderOf = new Map(
  manifests.map((file) => [(JSON.parse(read(file)) as { name: string }).name, dirname(file)]),
);
const sources = new Map(
  files
    .filter((file) => file.endsWith('.ts') && !file.endsWith('.d.ts') && !/\/(?:pkg|dist)\//.test(file))
    .map((file) => [file, read(file)]),
);

/** The folders that a folder's sources use, except in tests and developer tools. */
function usedBy(folder: string): Map<string, string> {
  const used = new Map<string, string>();
  for (const [file, text] of sources) {
    if (!file.startsWith(`${folder}/`) || DEVELOPERS.test(file)) continue;
    for (const name of importedPackages(text)) {
      const target = folderOf.get(name);
      if (target !== undefined && target !== folder) used.set(target, file);
    }
  }
  return used;
}

describe('the map', () => {
  test('has a row for each folder of the workspace and for no others', () => {
    expect(rooms.map(({ folder }) => folder).sort()).toEqual([...folders].sort());
  });

  test.each(rooms)('$folder uses only what it may', (room) => {
    const allowed = allowedFolders(room, rooms);
    const faults = [...usedBy(room.folder)].filter(([target]) => !allowed.has(target));
    expect(faults.map(([target, file]) => `${file} uses ${target}`)).toEqual([]);
  });

  test('lists libraries floor by floor', () => {
    const floors = new Map<string, number>();
    for (const room of rooms.filter(({ folder }) => /^(?:packages\/|wasm-codec$)/.test(folder))) {
      const below = [...allowedFolders(room, rooms)].map((folder) => floors.get(folder));
      expect(below, `what ${room.folder} may use is listed above it`).not.toContain(undefined);
      floors.set(room.folder, Math.max(-1, ...below.map((floor) => floor ?? 0)) + 1);
    }
    const listed = [...floors.values()];
    expect(listed).toEqual(listed.toSorted((a, b) => a - b));
  });

  test('has no cycle', () => {
    expect(cycles(new Map(folders.map((folder) => [folder, usedBy(folder).keys()])))).toEqual([]);
  });
});

test('every file that CONTRIBUTING.md names exists', () => {
  const named = [...read('CONTRIBUTING.md').matchAll(/\]\(([\w./-]+\.ts)\)/g)].map(([, file]) => file!);
  expect(named.length).toBeGreaterThanOrEqual(10);
  expect(named.filter((file) => !sources.has(file))).toEqual([]);
});

/** Sources that run in a browser. Parts for Node only have an export of their own. */
const BROWSER = /^(?:packages\/(?:grants|janus|protocol|timing|rtp|operator|cloud-view)|apps\/webxr)\/src\//;
const FOR_NODE = /^packages\/rtp\/src\/srtp\//;

test('browser code uses nothing of Node', () => {
  const faults = [...sources]
    .filter(([file]) => BROWSER.test(file) && !FOR_NODE.test(file) && !DEVELOPERS.test(file))
    .filter(([, text]) => /from 'node:/.test(text))
    .map(([file]) => file);
  expect(faults).toEqual([]);
});

test('browser code uses the small build of the schema library: zod/mini, not zod', () => {
  const faults = [...sources]
    .filter(([file, text]) => BROWSER.test(file) && /from 'zod'/.test(text))
    .map(([file]) => file);
  expect(faults).toEqual([]);
});

describe('sources', () => {
  test('no file imports itself through others', () => {
    const graph = new Map(
      [...sources].map(([file, text]) => [
        file,
        [...importedFiles(file, text)].filter((target) => sources.has(target)),
      ]),
    );
    expect(cycles(graph)).toEqual([]);
  });

  test('every thread and program that a file starts by its address exists', () => {
    const missing = [...sources]
      .filter(([file]) => !NAMES_WHAT_IS_NOT.test(file))
      .flatMap(([file, text]) =>
        [...startedFiles(file, text)]
          .filter((target) => !sources.has(target))
          .map((target) => `${file}: ${target}`),
      );
    expect(missing).toEqual([]);
  });

  test('a file imports from a module once: types stand among the other names', () => {
    const twice = [...sources].flatMap(([file, text]) =>
      repeatedImports(text).map((module) => `${file}: ${module}`),
    );
    expect(twice).toEqual([]);
  });

  test('what a program, a tool or a script exports has another user than its own file', () => {
    const files = new Map<string, number>();
    for (const text of sources.values()) {
      for (const word of new Set(text.match(/[A-Za-z_$][\w$]*/g)))
        files.set(word, (files.get(word) ?? 0) + 1);
    }
    const alone = [...sources]
      .filter(([file]) => /^(?:apps|tools|scripts|bench|e2e)\//.test(file) && !/\.test\.ts$/.test(file))
      .flatMap(([file, text]) =>
        [...text.matchAll(/^export (?:async )?(?:function\*?|const|let|class|enum) ([\w$]+)/gm)]
          .filter(([, name]) => files.get(name as string) === 1)
          .map(([, name]) => `${file}: ${name}`),
      );
    expect(alone).toEqual([]);
  });

  test('no file has under 15 lines, unless it is an entry: an index, an export of its package, or what no file imports', () => {
    const exported = new Set(
      manifests.flatMap((file) =>
        [...read(file).matchAll(/"\.\/(src\/[\w/-]+\.ts)"/g)].map(([, path]) => `${dirname(file)}/${path}`),
      ),
    );
    const imported = new Set([...sources].flatMap(([file, text]) => [...importedFiles(file, text)]));
    const dust = [...sources]
      .filter(
        ([file]) =>
          imported.has(file) &&
          !exported.has(file) &&
          !/\/index\.ts$|^e2e\//.test(file) &&
          !DEVELOPERS.test(file),
      )
      .filter(([, text]) => text.split('\n').length - 1 < LEAST_LINES)
      .map(([file]) => file);
    expect(dust).toEqual([]);
  });

  test('no literal is spread where it could stand: no line begins with `...{` or `...([`', () => {
    const spread = [...sources]
      .filter(([file]) => !DEVELOPERS.test(file) && !/^(?:e2e|tools\/scenario)\//.test(file))
      .flatMap(([file, text]) =>
        text
          .split('\n')
          .flatMap((line, i) =>
            /^\s*\.\.\.(?:\{ |\(\[[^\]]*\](?: as const)?\),?$)/.test(line) ? [`${file}:${i + 1}`] : [],
          ),
      );
    expect(spread).toEqual([]);
  });

  test('programs make folders by makeFolder: the recursive mkdir of Node never returns where none can be made', () => {
    const own = [...sources].filter(
      ([file, text]) =>
        /^(?:apps|packages)\/[^/]+\/src\//.test(file) &&
        !DEVELOPERS.test(file) &&
        /\bmkdir(?:Sync)?\([^;]*recursive/.test(text),
    );
    expect(own.map(([file]) => file)).toEqual([]);
  });

  test('a number with a unit says what it is for and where it comes from: a comment stands before it, before its neighbours, or beside it', () => {
    const silent = [...sources]
      .filter(([file]) => PRODUCTION.test(file) && !DEVELOPERS.test(file))
      .flatMap(([file, text]) => {
        let isSaid = false;
        return text.split('\n').flatMap((line, i) => {
          const [, name = ''] = NUMBER.exec(line) ?? [];
          isSaid = name === '' ? COMMENT_ENDS.test(line) : isSaid || /\/[/*]/.test(line);
          return !isSaid && WITH_UNIT.test(name) ? [`${file}:${i + 1}: ${name}`] : [];
        });
      });
    expect(silent).toEqual([]);
  });

  test(`no file is longer than ${MAX_LINES} lines`, () => {
    const long = [...sources]
      .filter(([file]) => !/\.test\.ts$/.test(file))
      .map(([file, text]) => ({ file, lines: text.split('\n').length - 1 }))
      .filter(({ lines }) => lines > MAX_LINES);
    expect(long).toEqual([]);
  });
});
