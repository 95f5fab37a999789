import {
  type PictureCodec,
  PictureCodecError,
  type PictureRows,
  rgbaRows,
  ShrinkingFilter,
  shrinkFactor,
} from '@farpoint/pictures';
import { MAX_PICTURE_BYTES, MAX_PICTURE_SIDE, type PictureFormat } from '@farpoint/protocol';
import { pictureRows, RosFault } from '@farpoint/ros';
import type { CameraPlan, OfferedPicture, PictureLoss } from './picture-messages.ts';

export interface MadePicture {
  format: PictureFormat;
  width: number;
  height: number;
  bytes: Uint8Array;
  /** Whether this is the source's own file, unchanged. */
  untouched: boolean;
}

/** A picture that cannot be shown. */
export class PictureLossError extends Error {
  override readonly name = 'PictureLossError';
  readonly reason: PictureLoss;

  constructor(reason: PictureLoss, detail: string, options?: ErrorOptions) {
    super(detail, options);
    this.reason = reason;
  }
}

const HEADER = { stamp: { sec: 0, nanosec: 0 }, frame_id: '' };

/** Makes a file from a source's picture that fits the plan. */
export class PictureMaker {
  readonly #codec: Pick<PictureCodec, 'encodeJpeg' | 'decode'>;
  readonly #filter = new ShrinkingFilter();

  constructor(codec: Pick<PictureCodec, 'encodeJpeg' | 'decode'>) {
    this.#codec = codec;
  }

  /** @throws {PictureLossError} */
  make({ facts, data }: Pick<OfferedPicture, 'facts' | 'data'>, plan: CameraPlan): MadePicture {
    try {
      if (facts.kind === 'raw') {
        const { width, height, step, encoding, bigEndian } = facts;
        const image = { header: HEADER, width, height, step, encoding, is_bigendian: bigEndian, data };
        return this.#encode(pictureRows(image), plan);
      }
      const { format, width, height } = facts;
      if (data.length <= plan.mostFileBytes && Math.max(width, height) <= plan.mostFileSide)
        return { format, width, height, bytes: data, untouched: true };
      const pixels = this.#codec.decode(format, data, MAX_PICTURE_SIDE * MAX_PICTURE_SIDE);
      if (pixels.width !== width || pixels.height !== height)
        throw new PictureCodecError(`${width} × ${height} pixels came as ${pixels.width} × ${pixels.height}`);
      return this.#encode(rgbaRows(pixels), plan);
    } catch (error) {
      throw lossOf(error);
    }
  }

  #encode(rows: PictureRows, { longestSide, quality }: CameraPlan): MadePicture {
    const small = this.#filter.shrink(rows, shrinkFactor(rows.width, rows.height, longestSide));
    const bytes = this.#codec.encodeJpeg(small, quality);
    if (bytes.length > MAX_PICTURE_BYTES)
      throw new PictureLossError('too-large', `${bytes.length} bytes, at most ${MAX_PICTURE_BYTES} are sent`);
    return { format: 'jpeg', width: small.width, height: small.height, bytes, untouched: false };
  }
}

function lossOf(error: unknown): PictureLossError {
  if (error instanceof PictureLossError) return error;
  if (error instanceof PictureCodecError)
    return new PictureLossError('unreadable', error.message, { cause: error });
  if (!(error instanceof RosFault)) throw error;
  const { code, message } = error;
  const reason = code === 'unsupported' || code === 'too-large' ? code : 'bad-image';
  return new PictureLossError(reason, message, { cause: error });
}
