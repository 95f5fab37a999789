/**
 * Reads the table of packages and dependencies in docs/architecture.md: the workspace's folders, and which others
 * each may use. Pure.
 */

export interface Room {
  folder: string;
  /** Last parts of the folders' names; `null`: every folder in the rows above. */
  mayUse: readonly string[] | null;
}

const ROW = /^\| `(?<folder>[\w/-]+)` \| .* \| (?<mayUse>[^|]*) \|$/;

export function parseRooms(markdown: string): Room[] {
  return markdown.split('\n').flatMap((line): Room[] => {
    const groups = ROW.exec(line)?.groups;
    if (groups === undefined) return [];
    const mayUse = groups.mayUse!.trim();
    if (mayUse === 'all of the above') return [{ folder: groups.folder!, mayUse: null }];
    const names = mayUse === '–' ? [] : mayUse.split(',').map((name) => name.trim());
    return [{ folder: groups.folder!, mayUse: names }];
  });
}

/** The folders that `room` may use. */
export function allowedFolders(room: Room, rooms: readonly Room[]): Set<string> {
  if (room.mayUse === null) return new Set(rooms.slice(0, rooms.indexOf(room)).map(({ folder }) => folder));
  const { mayUse } = room;
  return new Set(
    rooms.map(({ folder }) => folder).filter((folder) => mayUse.includes(folder.split('/').at(-1)!)),
  );
}
