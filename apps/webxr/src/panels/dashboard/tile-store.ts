/** Images of a map's tiles: fetched when asked for, a few at a time, and kept up to a limit. */
import { type MapTiles, tileUrl } from '../../ground/telemetry/map-tiles.ts';
import { laterTexts } from '../../words/language.ts';

/** About 50 MB of pixels; and as many at once as browsers ask one server for over HTTP/1.1. */
const MOST_KEPT = 192;
const MOST_LOADING = 6;
/**
 * A tile that could not be fetched is not asked for again for this long, ms. Chosen: servers of tiles ask for
 * little traffic.
 */
const RETRY_MS = 30_000;

interface Kept {
  readonly image: HTMLImageElement;
  state: 'loading' | 'ready' | 'failed';
  failedMs: number;
}

export class TileStore {
  /** Called when a tile has arrived. */
  onReady: (() => void) | null = null;
  readonly #tiles: MapTiles;
  /** The one used last is the last. */
  readonly #kept = new Map<string, Kept>();
  #loading = 0;

  constructor(tiles: MapTiles) {
    this.#tiles = tiles;
  }

  get attribution(): string {
    const { attribution, host } = this.#tiles;
    return attribution ?? laterTexts().dashboard.mapOf(host);
  }

  /** @returns `null` if it is not there (yet) */
  image(z: number, x: number, y: number, nowMs: number): HTMLImageElement | null {
    const key = `${z}/${x}/${y}`;
    const kept = this.#kept.get(key);
    if (kept !== undefined) {
      this.#kept.delete(key);
      if (kept.state !== 'failed' || nowMs - kept.failedMs < RETRY_MS) {
        this.#kept.set(key, kept);
        return kept.state === 'ready' ? kept.image : null;
      }
    }
    if (this.#loading < MOST_LOADING) this.#load(key, tileUrl(this.#tiles, z, x, y));
    return null;
  }

  /** Gives up what is being fetched. */
  close(): void {
    for (const { image } of this.#kept.values()) image.src = '';
    this.#kept.clear();
    this.onReady = null;
  }

  #load(key: string, url: string): void {
    const image = new Image();
    const kept: Kept = { image, state: 'loading', failedMs: 0 };
    const end = (state: Kept['state']) => {
      if (kept.state !== 'loading') return;
      kept.state = state;
      kept.failedMs = performance.now();
      this.#loading--;
      this.onReady?.();
    };
    // The page is isolated: images of other servers need their permission (CORS). It tells them nothing about itself.
    image.crossOrigin = 'anonymous';
    image.referrerPolicy = 'no-referrer';
    image.onload = () => end('ready');
    image.onerror = () => end('failed');
    this.#loading++;
    image.src = url;
    this.#kept.set(key, kept);
    for (const [oldest, { state }] of this.#kept) {
      if (this.#kept.size <= MOST_KEPT) break;
      if (state !== 'loading') this.#kept.delete(oldest);
    }
  }
}
