import type { VideoCodec } from '@farpoint/protocol';
import type { VideoRefusal } from './answered-codecs.ts';
import type { SrtpTransport } from './srtp-transport.ts';

/** A video's m-line, as it was negotiated with one operator. */
export interface VideoLine {
  /** `a=mid`. */
  mid: string;
  /** `null` if the operator refused the line, for example because it cannot decode any of the codecs. */
  transport: SrtpTransport | null;
  /** The payload type of each codec that the operator decodes; empty if it refused the line. */
  payloadTypes: ReadonlyMap<VideoCodec, number>;
  /** Why there is no transport; `null` if there is one. */
  refusal: VideoRefusal | null;
}
