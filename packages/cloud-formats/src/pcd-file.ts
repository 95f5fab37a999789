/** The parts of reading PCD files, for readers that make something else of the points; without the pictures' decoders. */
export { PcdError, type PcdField, type PcdHeader, parsePcdHeader } from './pcd-header.ts';
export { type PcdColumn, pcdPointReader } from './pcd-points.ts';
