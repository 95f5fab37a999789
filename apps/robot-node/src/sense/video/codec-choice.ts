/** Chooses the codec that a camera is encoded with, once for all who watch. */
import type { VideoCodec } from '@farpoint/protocol';

/** Somebody who watches a video. */
export interface CodecWatcher {
  readonly codecs: ReadonlySet<VideoCodec>;
  /** Whether it is the operator who drives. */
  readonly drives: boolean;
}

/**
 * A change that somebody would lose the picture by, or that nobody needs, has to be better for so long, ms.
 * A page that is loaded again, or an operator who comes and goes, does not make it flap. Chosen: a page is
 * loaded in less (docs/video.md, Codecs).
 */
const CALM_MS = 5000;

/**
 * The codec that serves everyone; else one that serves the driver; else the one that serves most. Of equals, the first.
 *
 * @param available in the order of preference, at least one
 */
export function bestCodec(available: readonly VideoCodec[], watchers: readonly CodecWatcher[]): VideoCodec {
  const served = (codec: VideoCodec) => watchers.filter(({ codecs }) => codecs.has(codec)).length;
  const forDriver = available.filter((codec) =>
    watchers.some((each) => each.drives && each.codecs.has(codec)),
  );
  // One that serves everyone serves the driver, too.
  const candidates = forDriver.length === 0 ? available : forDriver;
  const [first, ...others] = candidates as [VideoCodec, ...VideoCodec[]];
  return others.reduce((best, codec) => (served(codec) > served(best) ? codec : best), first);
}

/** The codec of one camera over time. */
export class CodecChoice {
  readonly #available: readonly VideoCodec[];
  #current: VideoCodec;
  /** A better codec that is not urgent, and since when it has been better. */
  #better: { codec: VideoCodec; sinceMs: number } | null = null;

  /** @param available in the order of preference, at least one */
  constructor(available: readonly VideoCodec[]) {
    this.#available = available;
    this.#current = available[0] as VideoCodec;
  }

  /** The codec to encode with. */
  get current(): VideoCodec {
    return this.#current;
  }

  /**
   * Takes into account who watches now.
   *
   * @param isFree nothing is encoded, so that a change costs nothing
   * @returns the codec to encode with
   */
  update(watchers: readonly CodecWatcher[], isFree: boolean, nowMs: number): VideoCodec {
    const best = bestCodec(this.#available, watchers);
    if (best === this.#current) this.#better = null;
    else if (isFree || isUrgent(watchers, this.#current, best)) this.#change(best);
    else if (this.#better?.codec !== best) this.#better = { codec: best, sinceMs: nowMs };
    else if (nowMs - this.#better.sinceMs >= CALM_MS) this.#change(best);
    return this.#current;
  }

  #change(codec: VideoCodec): void {
    this.#current = codec;
    this.#better = null;
  }
}

/** The driver has no picture and would get one; or somebody has none and would get one, and nobody would lose it. */
function isUrgent(watchers: readonly CodecWatcher[], current: VideoCodec, best: VideoCodec): boolean {
  const gaining = watchers.filter(({ codecs }) => codecs.has(best) && !codecs.has(current));
  if (gaining.some(({ drives }) => drives)) return true;
  const loses = watchers.some(({ codecs }) => codecs.has(current) && !codecs.has(best));
  return gaining.length > 0 && !loses;
}
