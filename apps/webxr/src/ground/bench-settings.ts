/**
 * What tests and benchmarks add to the page's address. The deployed page does not read it: nobody can measure that page,
 * and nothing in a link should make it slow, or its canvas small.
 */
export interface BenchSettings {
  /** Fixed size of the canvas in pixels; `null`: that of the window. */
  canvas: { width: number; height: number } | null;
  /** Whether each picture is waited for until the GPU has finished it, so that its time is known. It costs frames. */
  measure: boolean;
  /** Draw only every n-th point, where a GPU is emulated; `null`: draw as many as possible. */
  drawEvery: number | null;
  /** Whether the robot draws the capture time into videos, to measure latency. */
  barcode: boolean;
  /** Whether the first drive is shown by itself, as the deployed page shows it. */
  tour: boolean;
}

export const NO_BENCH: Readonly<BenchSettings> = {
  canvas: null,
  measure: false,
  drawEvery: null,
  barcode: false,
  tour: true,
};

/** The largest side of a canvas in the address, pixels: what WebGL 2 draws on any common GPU. */
const MAX_CANVAS = 8192;

/** @param query the page's query string */
export function readBenchSettings(query: URLSearchParams): BenchSettings {
  return {
    canvas: parseCanvas(query.get('canvas')),
    measure: query.get('measure') === '1',
    drawEvery: parseEvery(query.get('every')),
    barcode: query.get('barcode') === '1',
    tour: query.get('tour') === '1',
  };
}

function parseEvery(text: string | null): number | null {
  const every = Number(text);
  return text !== null && Number.isInteger(every) && every >= 1 && every <= 1024 ? every : null;
}

function parseCanvas(text: string | null): BenchSettings['canvas'] {
  const match = /^(\d{1,5})x(\d{1,5})$/.exec(text ?? '');
  if (match === null) return null;
  const [width, height] = [Number(match[1]), Number(match[2])];
  if (width < 16 || height < 16 || width > MAX_CANVAS || height > MAX_CANVAS) return null;
  return { width, height };
}
