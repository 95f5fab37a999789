/** Sums a CPU profile of the page's main thread, as Chromium's DevTools protocol gives it. */

/** `Profiler.Profile`, as far as it is read. */
export interface CpuProfile {
  nodes: readonly { id: number; callFrame: { functionName: string } }[];
  /** The node that each sample was in. */
  samples?: readonly number[];
  /** Time before each sample, µs. */
  timeDeltas?: readonly number[];
}

/** Where the time went, ms. */
export interface MainThreadTime {
  /** JavaScript and WebAssembly, with collecting garbage. */
  scriptMs: number;
  /** Waiting for what was drawn: the renderer's work, not the page's. */
  waitingMs: number;
  /** The browser's own work on this thread: events, styles, compositing. */
  browserMs: number;
  idleMs: number;
}

/** What waits for the GPU: the page reads a pixel to know when a picture is done. */
const WAITS = new Set(['readPixels', 'finish', 'clientWaitSync', 'getSyncParameter']);

export function mainThreadTime({ nodes, samples = [], timeDeltas = [] }: CpuProfile): MainThreadTime {
  const names = new Map(nodes.map(({ id, callFrame }) => [id, callFrame.functionName]));
  const time: MainThreadTime = { scriptMs: 0, waitingMs: 0, browserMs: 0, idleMs: 0 };
  for (const [i, id] of samples.entries()) {
    // A sample's node has run since the sample before it. The first deltas may be negative.
    const ms = Math.max(0, (timeDeltas[i] ?? 0) / 1000);
    const name = names.get(id) ?? '';
    if (name === '(idle)') time.idleMs += ms;
    else if (name === '(program)' || name === '(root)') time.browserMs += ms;
    else if (WAITS.has(name)) time.waitingMs += ms;
    else time.scriptMs += ms;
  }
  return time;
}
