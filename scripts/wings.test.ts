/** Compares the table of wings in docs/architecture.md with what the two large programs' sources import, types included, and which threads they start. */
import { dirname } from 'node:path/posix';
import { describe, expect, test } from 'vitest';
import { cycles } from './lib/cycles.ts';
import { importedFiles, startedFiles } from './lib/file-imports.ts';
import { allowedFolders, parseRooms } from './lib/rooms.ts';
import { readWorkspaceFile as read, workspaceFiles } from './lib/workspace-files.ts';

const TESTS = /\.test\.ts$|\/testing\//;

const wings = parseRooms(read('docs/architecture.md')).filter(({ folder }) => folder.includes('/src/'));
const programs = [...new Set(wings.map(({ folder }) => dirname(folder)))];

describe.each(programs)('%s', (program) => {
  const own = wings.filter(({ folder }) => dirname(folder) === program);
  const files = workspaceFiles.filter(
    (file) => file.startsWith(`${program}/`) && file.endsWith('.ts') && !TESTS.test(file),
  );
  const known = new Set(files);
  const imports = files.map((file) => ({
    file,
    used: [...importedFiles(file, read(file)), ...startedFiles(file, read(file))].filter((target) =>
      known.has(target),
    ),
  }));
  /** Of a file; `null` above all wings. */
  const wingOf = (file: string) => {
    const [wing, ...path] = file.slice(program.length + 1).split('/');
    return path.length === 0 ? null : `${program}/${wing}`;
  };

  test('has a row for each wing, and for nothing else', () => {
    const there = new Set(files.flatMap((file) => wingOf(file) ?? []));
    expect(own.map(({ folder }) => folder).sort()).toEqual([...there].sort());
  });

  test.each(own)('$folder uses only what it may', (wing) => {
    const allowed = new Set<string | null>([wing.folder, ...allowedFolders(wing, own)]);
    const faults = imports
      .filter(({ file }) => wingOf(file) === wing.folder)
      .flatMap(({ file, used }) =>
        used.filter((target) => !allowed.has(wingOf(target))).map((target) => `${file} uses ${target}`),
      );
    expect(faults).toEqual([]);
  });

  test('has no two folders that reach each other', () => {
    const graph = new Map<string, Set<string>>();
    for (const { file, used } of imports) {
      const targets = graph.get(dirname(file)) ?? new Set();
      graph.set(dirname(file), targets);
      for (const target of used) if (dirname(target) !== dirname(file)) targets.add(dirname(target));
    }
    expect(cycles(graph)).toEqual([]);
  });
});

test('the two large programs have wings', () => {
  expect(programs).toEqual(['apps/robot-node/src', 'apps/webxr/src']);
});
