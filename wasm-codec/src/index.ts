export { CloudDecoder } from './cloud-decoder.ts';
export { type Codec, type CodecSource, loadCodec, loadCodecSync } from './codec.ts';
export { CodecError, type CodecErrorCode } from './errors.ts';
export { maxPoints, type PointBudget } from './max-points.ts';
export {
  cellClasses,
  ObstacleGrid,
  type ObstacleGridSettings,
  type SeenCells,
} from './obstacle-grid.ts';
export type { OrganisedColour } from './organised-colour.ts';
export {
  OrganisedDecoder,
  type PacketFault,
  type PutResult,
  TILE,
  TILE_SAMPLES,
} from './organised-decoder.ts';
export {
  type GridResult,
  type Misfit,
  OrganisedEncoder,
  type OrganisedOptions,
  type OrganisedReasons,
  type OrganisedReport,
  type Pinhole,
  type Thinning,
} from './organised-encoder.ts';
export {
  type ImageSamplingParameters,
  type PackOptions,
  type PackReport,
  Points64Encoder,
  type RejectedPoints,
  type SampleReport,
  type SamplingParameters,
} from './points64-encoder.ts';
export {
  BYTES_PER_POINT,
  DEFAULT_SLOT_LAYOUT,
  POINTS_PER_PACKET,
  packetsFor,
  type SlotLayout,
} from './slot-layout.ts';
export {
  UnorganisedDecoder,
  type UnorganisedDecoderOptions,
  type UnorganisedFault,
  type UnorganisedPlace,
} from './unorganised-decoder.ts';
export {
  type UnorganisedAttribute,
  UnorganisedEncoder,
  type UnorganisedOrder,
  type UnorganisedReport,
  type UnorganisedSettings,
} from './unorganised-encoder.ts';
