/** Messages between the page and the worker that reads capture stamps. */
import type { VideoCodec } from '@farpoint/protocol';

/** Which video a receiver's frames are of. */
export interface StampOptions {
  /** Number of the attempt to watch, by which stamps of an earlier one are recognised. */
  generation: number;
  video: number;
  codec: VideoCodec;
}

/** In browsers without `RTCRtpScriptTransform`: the receiver's streams of encoded frames. */
export type ToStampWorker = StampOptions & { readable: ReadableStream; writable: WritableStream };

/** One frame has come. */
export interface FromStampWorker {
  generation: number;
  video: number;
  rtpTimestamp: number;
  /** On the robot's clock, ms; `null` if the frame does not say. */
  captureMs: number | null;
}
