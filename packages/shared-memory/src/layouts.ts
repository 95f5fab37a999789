/** What reads files of other programs, for those who test it. */
export {
  HEADER_BYTES,
  makeHeader,
  parseFrameHeader,
  parseHeader,
  writeFrameHeader,
  writeHeader,
} from './cloud/layout.ts';
