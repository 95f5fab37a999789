import { expect, test } from 'vitest';
import type { ShownCommand } from '../../state/commands-state.ts';
import type { ConsoleActions } from './console-actions.ts';
import { commandPages, type MenuCommands } from './menu-commands.ts';
import type { MenuItem } from './menu-item.ts';

const free = (id: string, shown: Partial<ShownCommand> = {}): ShownCommand => ({
  id,
  text: id,
  note: '',
  state: 'free',
  progress: null,
  cancel: null,
  ...shown,
});
const only = (commands: readonly ShownCommand[], recording: MenuCommands['recording'] = null) =>
  commandPages({ groups: [{ name: '', commands }], recording });

/** What an entry does, in one line; `null`: nothing. */
function doneBy({ choice }: MenuItem): string | null {
  if (choice === null || !('act' in choice)) return null;
  const done: string[] = [];
  choice.act(
    new Proxy({} as ConsoleActions, {
      get:
        (_, name) =>
        (...given: unknown[]) =>
          void done.push([name, ...given].join(' ')),
    }),
  );
  expect(choice.closes).toBe(false);
  return done.join();
}

test('each command is one entry, with its state below it, and does what its button does', () => {
  const [page = []] = only([
    free('lights'),
    free('horn', { state: 'barred', note: 'only the driver may' }),
    free('dock', { state: 'armed', text: 'Press again: Dock' }),
    free('test', { state: 'running', note: 'turning', progress: 0.456 }),
    free('scan', { state: 'running', progress: 0.5, cancel: 'Cancel: Scan' }),
  ]);
  expect(page.map((item) => [item.text, item.note, item.tone, doneBy(item)])).toEqual([
    ['lights', '', 'neutral', 'pressCommand lights'],
    // The press that does nothing is told why, as on the page.
    ['horn', 'only the driver may', 'quiet', 'pressCommand horn'],
    ['Press again: Dock', '', 'warning', 'pressCommand dock'],
    ['test', '46 %, turning', 'chosen', null],
    ['Cancel: Scan', '50 %', 'chosen', 'cancelCommand scan'],
  ]);
});

test('the recording stands first with its line, then the groups under their names', () => {
  const [page = []] = commandPages({
    groups: [
      { name: 'Signals', commands: [free('horn')] },
      { name: '', commands: [free('scan')] },
    ],
    recording: { isOn: true, line: 'Recording 1:02', button: free('stop'), bookmark: free('bookmark') },
  });
  expect(page.map(({ text }) => text)).toEqual([
    'Recording 1:02',
    'stop',
    'bookmark',
    'Signals',
    'horn',
    'Other commands',
    'scan',
  ]);
  expect(page.map(doneBy)[2]).toBe('pressCommand bookmark');
  expect(
    commandPages({ groups: [], recording: { isOn: true, line: 'Recording', button: null, bookmark: null } }),
  ).toEqual([[{ text: 'Recording', choice: null, tone: 'bad' }]]);
});

test('as many as a robot can have are on pages that fit, none is lost, and no heading stands alone', () => {
  const commands = Array.from({ length: 29 }, (_, n) => free(`c${n}`));
  const groups = [
    { name: 'A', commands: commands.slice(0, 3) },
    { name: 'B', commands: commands.slice(3, 4) },
    { name: 'C', commands: commands.slice(4) },
  ];
  const recording = { isOn: true, line: 'On', button: free('stop'), bookmark: free('bookmark') };
  const pages = commandPages({ groups, recording });
  for (const page of pages) {
    const rows = page.reduce((sum, { note }) => sum + (note === undefined ? 1 : 2), 0);
    // With the title, More and Back, as menu-state.test.ts counts.
    expect(rows).toBeLessThanOrEqual(13);
    expect(page.at(-1)?.choice).not.toBeNull();
    expect(page[0]?.choice).toBeNull();
  }
  expect(pages.flat().filter(({ choice }) => choice !== null)).toHaveLength(31);
  expect(pages.at(-1)?.[0]?.text).toBe('C');
});
