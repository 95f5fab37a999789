/// <reference lib="webworker" />
/** Reads the capture stamps of encoded video frames on their way to the decoder. */
import { readCaptureStamp } from '@farpoint/protocol';
import { msOfNs } from '@farpoint/timing';
import type { FromStampWorker, StampOptions, ToStampWorker } from './stamp-messages.ts';

declare const self: DedicatedWorkerGlobalScope & {
  onrtctransform: ((event: RTCTransformEvent) => void) | null;
};

/** An encoded frame; browsers tell its RTP timestamp in one place or the other. */
interface Frame {
  data: ArrayBuffer;
  timestamp?: number;
  getMetadata(): { rtpTimestamp?: number };
}

self.onrtctransform = ({ transformer }: RTCTransformEvent) =>
  relay(transformer.readable, transformer.writable, transformer.options as StampOptions);
self.onmessage = ({ data }: MessageEvent<ToStampWorker>) => relay(data.readable, data.writable, data);

function relay(readable: ReadableStream, writable: WritableStream, options: StampOptions): void {
  const { generation, video, codec } = options;
  const reading = new TransformStream<Frame, Frame>({
    transform(frame, controller) {
      const rtpTimestamp = frame.getMetadata().rtpTimestamp ?? frame.timestamp;
      const captureNs = readCaptureStamp(new Uint8Array(frame.data), codec);
      if (rtpTimestamp !== undefined) {
        const captureMs = captureNs === null ? null : msOfNs(captureNs);
        self.postMessage({ generation, video, rtpTimestamp, captureMs } satisfies FromStampWorker);
      }
      controller.enqueue(frame);
    },
  });
  // It ends with the connection.
  readable
    .pipeThrough(reading)
    .pipeTo(writable)
    .catch(() => undefined);
}
