export { intensityColour, intensityScale } from './intensity.ts';
export {
  decodePcd,
  type PcdCloud,
  PcdError,
  type PcdErrorCode,
  type PcdHeader,
  parsePcdHeader,
  pcdIntensity,
} from './pcd.ts';
export {
  type ColourImage,
  type DepthImage,
  decodeColourJpeg,
  decodeDepthPng,
  imagesOfRgbd,
  parseIntrinsics,
  pointsOfRgbd,
  RgbdError,
} from './rgbd.ts';
export { parseTrajectoryLog, TrajectoryError } from './trajectory-log.ts';
