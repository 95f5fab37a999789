/** Decodes pictures off the main thread. The bytes are untrusted: only files as announced are decoded. */
import { readPictureFile } from '@farpoint/protocol';
import type { FromPictureWorker, PictureToDecode } from './decode-queue.ts';

declare const self: DedicatedWorkerGlobalScope;

/** Longest side of the bitmaps for the page, pixels: its panels are no larger. */
const MOST_SIDE = 1280;
const TYPES = { jpeg: 'image/jpeg', png: 'image/png' } as const;

self.onmessage = ({ data }: MessageEvent<PictureToDecode>) => {
  void decode(data);
};

async function decode({ ticket, format, width, height, bytes }: PictureToDecode): Promise<void> {
  try {
    // Check before decoding: a small file may claim to be a huge picture.
    const file = readPictureFile(bytes);
    if (typeof file === 'string') throw new Error(file);
    if (file.format !== format || file.width !== width || file.height !== height)
      throw new Error(`a file of ${file.width} × ${file.height} pixels as ${width} × ${height}`);
    const factor = Math.max(1, Math.max(width, height) / MOST_SIDE);
    const bitmap = await createImageBitmap(new Blob([bytes], { type: TYPES[format] }), {
      ...(factor === 1 ? {} : { resizeWidth: Math.max(1, Math.round(width / factor)) }),
      // Ignore rotation in the metadata, so that the size is as announced.
      imageOrientation: 'none',
    });
    tell({ ticket, bitmap }, [bitmap]);
  } catch (error) {
    tell({ ticket, fault: error instanceof Error ? error.message : String(error) }, []);
  }
}

function tell(message: FromPictureWorker, transfer: Transferable[]): void {
  self.postMessage(message, transfer);
}
