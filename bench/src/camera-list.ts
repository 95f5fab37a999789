/** The list of cameras that a benchmark takes: `1024x768@30:512,…`. */
export interface BenchCamera {
  width: number;
  height: number;
  framesPerS: number;
  kbitPerS: number;
}

/** @throws {Error} naming what is wrong */
export function parseCameras(text: string): BenchCamera[] {
  return text.split(',').map((each) => {
    const match = /^(\d{2,4})x(\d{2,4})@(\d{1,3}):(\d{2,6})$/.exec(each.trim());
    if (match === null) throw new Error(`--cameras: \`${each}\` is not like 1024x768@30:512`);
    const [width, height, framesPerS, kbitPerS] = match.slice(1).map(Number) as [
      number,
      number,
      number,
      number,
    ];
    return { width, height, framesPerS, kbitPerS };
  });
}
