export { PictureCodec, PictureCodecError, type PicturePixels } from './picture-codec.ts';
export { type PictureRows, rgbaRows, ShrinkingFilter, shrinkFactor, shrunkSize } from './shrinking-filter.ts';
