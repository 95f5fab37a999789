import { BARCODE_HEIGHT, BARCODE_WIDTH, msOfBarcodeTime, readBarcode } from '@farpoint/protocol';
import type { Page } from '@playwright/test';

/** What a page shows of a robot's videos at one moment. Times are on the robot's clock, ms. */
export interface ShownVideos {
  nowMs: number;
  videos: {
    /** When the shown picture was captured, as the page knows it. */
    knownMs: number;
    /** The same as it is drawn in the picture; `null` if it cannot be read. */
    drawnMs: number | null;
  }[];
}

/** Reads the canvases of these videos without a pause in between. The page must have asked for the barcode. */
export async function readShownVideos(page: Page, videos: readonly number[]): Promise<ShownVideos> {
  const read = await page.evaluate(
    ({ numbers, width, height }) => {
      const nowMs = window.farpoint.robotNowMs() ?? Number.NaN;
      const probes = window.farpoint.videos();
      const text = (bytes: Uint8ClampedArray) => {
        let all = '';
        for (const byte of bytes) all += String.fromCharCode(byte);
        return btoa(all);
      };
      return {
        nowMs,
        videos: numbers.map((video) => {
          const context = window.farpoint.videoCanvas(video)?.getContext('2d');
          const pixels = context?.getImageData(0, 0, width, height).data ?? new Uint8ClampedArray();
          return { knownMs: probes[video]?.captureMs ?? Number.NaN, pixels: text(pixels) };
        }),
      };
    },
    { numbers: videos, width: BARCODE_WIDTH, height: BARCODE_HEIGHT },
  );
  return {
    nowMs: read.nowMs,
    videos: read.videos.map(({ knownMs, pixels }) => {
      const bytes = Buffer.from(pixels, 'base64');
      const { time } = readBarcode(bytes, BARCODE_WIDTH, BARCODE_HEIGHT, BARCODE_WIDTH * 4, 4);
      return { knownMs, drawnMs: time === null ? null : msOfBarcodeTime(time) };
    }),
  };
}
