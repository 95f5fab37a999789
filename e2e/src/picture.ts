import type { Page } from '@playwright/test';

/** Facts about a part of a screenshot. */
export interface PictureFacts {
  /** Share of pixels that differ from the most frequent colour by more than 24 in some channel, 0–1. */
  drawnShare: number;
  /** Share of pixels with the latency test's green, 0–1. */
  greenShare: number;
  /** How many of the 512 colours with 3 bits per channel occur in at least 0.05 % of the pixels. */
  colours: number;
  /** Mean lightness, 0–255. */
  lightness: number;
}

export interface Part {
  /** Fractions of the picture's width and height, 0–1. */
  left: number;
  top: number;
  width: number;
  height: number;
}

export const leftEye: Part = { left: 0, top: 0, width: 0.5, height: 1 };
export const rightEye: Part = { left: 0.5, top: 0, width: 0.5, height: 1 };

/** Reads parts of a PNG in a blank page of the same browser, which has the decoder. */
export async function readPicture(page: Page, png: Buffer, parts: Part[]): Promise<PictureFacts[]> {
  const reader = await page.context().newPage();
  try {
    return await reader.evaluate(readParts, { base64: png.toString('base64'), parts });
  } finally {
    await reader.close();
  }
}

/** Share of pixels in which two parts of the same size differ visibly, 0–1. */
export async function differingShare(page: Page, png: Buffer, a: Part, b: Part): Promise<number> {
  const reader = await page.context().newPage();
  try {
    return await reader.evaluate(compareParts, { base64: png.toString('base64'), a, b });
  } finally {
    await reader.close();
  }
}

async function readParts(input: { base64: string; parts: Part[] }): Promise<PictureFacts[]> {
  const blob = await (await fetch(`data:image/png;base64,${input.base64}`)).blob();
  const bitmap = await createImageBitmap(blob);
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext('2d') as OffscreenCanvasRenderingContext2D;
  context.drawImage(bitmap, 0, 0);
  return input.parts.map((part) => {
    const { data } = context.getImageData(
      Math.round(part.left * bitmap.width),
      Math.round(part.top * bitmap.height),
      Math.round(part.width * bitmap.width),
      Math.round(part.height * bitmap.height),
    );
    const pixels = data.length / 4;
    const histogram = new Map<number, number>();
    for (let i = 0; i < data.length; i += 4) {
      const key = ((data[i] as number) << 16) | ((data[i + 1] as number) << 8) | (data[i + 2] as number);
      histogram.set(key, (histogram.get(key) ?? 0) + 1);
    }
    let background = 0;
    let most = 0;
    for (const [key, count] of histogram) if (count > most) [background, most] = [key, count];
    let drawn = 0;
    let green = 0;
    let light = 0;
    const coarse = new Uint32Array(512);
    for (const [key, count] of histogram) {
      const [r, g, b] = [key >> 16, (key >> 8) & 255, key & 255];
      const away = Math.max(
        Math.abs(r - (background >> 16)),
        Math.abs(g - ((background >> 8) & 255)),
        Math.abs(b - (background & 255)),
      );
      if (away > 24) drawn += count;
      if (g > 200 && r < 60 && b < 60) green += count;
      light += count * (0.3 * r + 0.59 * g + 0.11 * b);
      const bin = ((r >> 5) << 6) | ((g >> 5) << 3) | (b >> 5);
      coarse[bin] = (coarse[bin] as number) + count;
    }
    const colours = coarse.filter((count) => count > pixels * 0.0005).length;
    return { drawnShare: drawn / pixels, greenShare: green / pixels, colours, lightness: light / pixels };
  });
}

async function compareParts(input: { base64: string; a: Part; b: Part }): Promise<number> {
  const blob = await (await fetch(`data:image/png;base64,${input.base64}`)).blob();
  const bitmap = await createImageBitmap(blob);
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext('2d') as OffscreenCanvasRenderingContext2D;
  context.drawImage(bitmap, 0, 0);
  const cut = (part: Part): Uint8ClampedArray =>
    context.getImageData(
      Math.round(part.left * bitmap.width),
      Math.round(part.top * bitmap.height),
      Math.round(part.width * bitmap.width),
      Math.round(part.height * bitmap.height),
    ).data;
  const [a, b] = [cut(input.a), cut(input.b)];
  let differing = 0;
  for (let i = 0; i < a.length; i += 4) {
    const away = Math.max(
      Math.abs((a[i] as number) - (b[i] as number)),
      Math.abs((a[i + 1] as number) - (b[i + 1] as number)),
      Math.abs((a[i + 2] as number) - (b[i + 2] as number)),
    );
    if (away > 24) differing++;
  }
  return differing / (a.length / 4);
}

/** Red, green and blue, 0–255. */
export type Rgb = readonly [red: number, green: number, blue: number];

/**
 * For each colour, the share of a part's pixels that differ from it by at most `tolerance` in every channel, 0–1.
 */
export async function sharesNear(
  page: Page,
  png: Buffer,
  part: Part,
  colours: Rgb[],
  tolerance = 20,
): Promise<number[]> {
  const reader = await page.context().newPage();
  try {
    return await reader.evaluate(readShares, { base64: png.toString('base64'), part, colours, tolerance });
  } finally {
    await reader.close();
  }
}

async function readShares(input: {
  base64: string;
  part: Part;
  colours: Rgb[];
  tolerance: number;
}): Promise<number[]> {
  const blob = await (await fetch(`data:image/png;base64,${input.base64}`)).blob();
  const bitmap = await createImageBitmap(blob);
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext('2d') as OffscreenCanvasRenderingContext2D;
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(
    Math.round(input.part.left * bitmap.width),
    Math.round(input.part.top * bitmap.height),
    Math.round(input.part.width * bitmap.width),
    Math.round(input.part.height * bitmap.height),
  );
  return input.colours.map((colour) => {
    let near = 0;
    for (let i = 0; i < data.length; i += 4) {
      const isNear = (value: number, channel: number): boolean =>
        Math.abs(value - (data[i + channel] as number)) <= input.tolerance;
      if (colour.every(isNear)) near++;
    }
    return near / (data.length / 4);
  });
}
