import type { SrtpTransport } from './srtp-transport.ts';

/** A video's m-line, as it was negotiated with one operator. */
export interface VideoLine {
  /** `a=mid`. */
  mid: string;
  /** `null` if the operator refused the line, for example because it cannot decode the codec. */
  transport: SrtpTransport | null;
}
