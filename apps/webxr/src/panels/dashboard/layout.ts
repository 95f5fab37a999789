/** Which tiles the dashboard shows, in which order and size. What the browser has stored is checked; no DOM here. */
import * as z from 'zod/mini';

export const TILE_SIZES = ['small', 'medium', 'large'] as const;
export type TileSize = (typeof TILE_SIZES)[number];

/** How far back curves reach, s. */
export const WINDOWS_S = [30, 120, 600, 3600] as const;
export type WindowS = (typeof WINDOWS_S)[number];

export interface PlacedTile {
  readonly id: string;
  readonly size: TileSize;
  readonly shown: boolean;
}

/** What is stored. */
export interface Layout {
  readonly version: 1;
  readonly windowS: WindowS;
  /** In their order. Tiles that are not listed follow, as they are by default. */
  readonly tiles: readonly PlacedTile[];
}

/** More than a robot's quantities and the fixed tiles. */
const MOST_TILES = 160;
const MOST_ID = 400;

const layoutSchema = z.strictObject({
  version: z.literal(1),
  windowS: z.literal(WINDOWS_S),
  tiles: z
    .array(
      z.strictObject({
        id: z.string().check(z.minLength(1), z.maxLength(MOST_ID)),
        size: z.enum(TILE_SIZES),
        shown: z.boolean(),
      }),
    )
    .check(z.maxLength(MOST_TILES)),
}) satisfies z.ZodMiniType<Layout>;

export const DEFAULT_LAYOUT: Layout = { version: 1, windowS: 120, tiles: [] };

/** @returns the defaults for anything that {@link layoutText} has not written */
export function parseLayout(text: string | null): Layout {
  try {
    const parsed = layoutSchema.safeParse(JSON.parse(text ?? ''));
    return parsed.success ? parsed.data : DEFAULT_LAYOUT;
  } catch {
    return DEFAULT_LAYOUT;
  }
}

export function layoutText(layout: Layout): string {
  return JSON.stringify(layout);
}

/** The tiles that there are, in the layout's order. @param available each as it is by default, in the default order */
export function placed(layout: Layout, available: readonly PlacedTile[]): PlacedTile[] {
  const defaults = new Map(available.map((tile) => [tile.id, tile]));
  const listed = new Map(layout.tiles.map((tile) => [tile.id, tile]));
  const known = [...listed.values()].filter(({ id }) => defaults.has(id));
  return [...known, ...available.filter(({ id }) => !listed.has(id))];
}

/** Exchanges a tile with the shown one before (−1) or after it (1). */
export function moved(layout: Layout, available: readonly PlacedTile[], id: string, by: -1 | 1): Layout {
  const tiles = placed(layout, available);
  const from = tiles.findIndex((tile) => tile.id === id);
  let to = from + by;
  while (tiles[to]?.shown === false) to += by;
  const [tile, other] = [tiles[from], tiles[to]];
  if (tile === undefined || other === undefined) return layout;
  tiles[from] = other;
  tiles[to] = tile;
  return withTiles(layout, tiles);
}

export function changed(
  layout: Layout,
  available: readonly PlacedTile[],
  id: string,
  change: Partial<Pick<PlacedTile, 'size' | 'shown'>>,
): Layout {
  const tiles = placed(layout, available).map((tile) => (tile.id === id ? { ...tile, ...change } : tile));
  return withTiles(layout, tiles);
}

/** Tiles of other robots stay listed, behind, as long as there is room. */
function withTiles(layout: Layout, tiles: readonly PlacedTile[]): Layout {
  const here = new Set(tiles.map(({ id }) => id));
  const others = layout.tiles.filter(({ id }) => !here.has(id));
  // Only what the schema has: kinds of tiles have more.
  const kept = [...tiles, ...others].map(({ id, size, shown }) => ({ id, size, shown }));
  return { ...layout, tiles: kept.slice(0, MOST_TILES) };
}
