/** Which robots are shown side by side, from the page's address. Pure. */
import { robotIdSchema } from '@farpoint/protocol';

/**
 * Pages on one screen. Chosen: each decodes and draws a robot's whole stream; more would all be slow. wall-settings.test.ts holds
 * it.
 */
export const MOST_CELLS = 4;
/** Of the wall itself; everything else in its address is for the pages. */
const OWN = 'robots';

export interface WallSettings {
  /** A robot's id for each page; `null`: a page on which the operator chooses one. */
  readonly robots: readonly (string | null)[];
  /** Parameters for each page's address. */
  readonly forPages: URLSearchParams;
}

/** Nonsense and repetitions are left out. Without any robot, there is one page to choose one on. */
export function readWallSettings(query: URLSearchParams): WallSettings {
  const asked = (query.get(OWN) ?? '').split(',').filter((id) => robotIdSchema.safeParse(id).success);
  const robots = [...new Set(asked)].slice(0, MOST_CELLS);
  return { robots: robots.length === 0 ? [null] : robots, forPages: pageParameters(query) };
}

/** What an address of the page or of the wall has for every page of a wall. */
export function pageParameters(query: URLSearchParams): URLSearchParams {
  const forPages = new URLSearchParams(query);
  forPages.delete(OWN);
  forPages.delete('robot');
  return forPages;
}

/** The address of a page in the wall, relative to the wall's. */
export function pageAddress(robot: string | null, forPages: URLSearchParams): string {
  const query = new URLSearchParams(forPages);
  if (robot !== null) query.set('robot', robot);
  const text = query.toString();
  return `./${text === '' ? '' : `?${text}`}`;
}

/** The wall's address with these robots. */
export function wallAddress(robots: readonly string[], forPages: URLSearchParams): string {
  const query = new URLSearchParams(forPages);
  if (robots.length > 0) query.set(OWN, robots.join(','));
  const text = query.toString().replaceAll('%2C', ',');
  return `./wall.html${text === '' ? '' : `?${text}`}`;
}
