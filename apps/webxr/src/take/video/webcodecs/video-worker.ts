/// <reference lib="webworker" />
/** The worker that takes videos' encoded frames from the browser's receivers and decodes them. */
import type { VideoCodec } from '@farpoint/operator';
import { codecOfFrame } from './codec-of-frame.ts';
import { standInPicture } from './stand-in-picture.ts';
import { VideoDecoding, type VideoDecodingPort } from './video-decoding.ts';
import type { FromVideoWorker, ToVideoWorker, VideoTransformOptions } from './worker-messages.ts';

declare const self: DedicatedWorkerGlobalScope & {
  onrtctransform: ((event: RTCTransformEvent) => void) | null;
};

/** How often the page is told what was dropped, ms: as often as people can read. */
const TELL_DROPS_EVERY_MS = 250;

/** By receiver: how its frames are to be decoded. Messages may come before the transform does. */
const receptions = new Map<number, Reception>();

interface Reception {
  /** As the page says; `null` if nobody wants the frames. */
  codec: VideoCodec | null;
  decoding: { readonly codec: VideoCodec; readonly video: VideoDecoding } | null;
}

self.onmessage = ({ data: { receiver, codec } }: MessageEvent<ToVideoWorker>) => {
  const reception = receptionOf(receiver);
  if (reception.codec === codec) return;
  reception.codec = codec;
  if (codec === null) end(reception);
};

self.onrtctransform = ({ transformer }: RTCTransformEvent) => void receive(transformer);

function receptionOf(receiver: number): Reception {
  const reception = receptions.get(receiver) ?? { codec: null, decoding: null };
  receptions.set(receiver, reception);
  return reception;
}

/** Decodes no more with the present decoder. */
function end(reception: Reception): void {
  reception.decoding?.video.close();
  reception.decoding = null;
}

async function receive(transformer: RTCRtpScriptTransformer): Promise<void> {
  const { receiver } = transformer.options as VideoTransformOptions;
  const reception = receptionOf(receiver);
  const port = portOf(receiver, transformer);
  const frames = transformer.readable as ReadableStream<RTCEncodedVideoFrame>;
  const back = (transformer.writable as WritableStream<RTCEncodedVideoFrame>).getWriter();
  try {
    for await (const frame of frames) {
      if (reception.codec !== null) {
        const codec = codecOfFrame(frame.getMetadata()) ?? reception.codec;
        if (reception.decoding?.codec !== codec) end(reception);
        reception.decoding ??= { codec, video: new VideoDecoding(codec, port) };
        reception.decoding.video.take(frame, rtpTimestampOf(frame));
        frame.data = standInPicture(codec);
      }
      await back.write(frame);
    }
  } catch {
    // The connection has ended.
  } finally {
    end(reception);
    receptions.delete(receiver);
  }
}

function portOf(receiver: number, transformer: RTCRtpScriptTransformer): VideoDecodingPort {
  const tell = (message: FromVideoWorker, transfer: Transferable[] = []) =>
    self.postMessage(message, transfer);
  let toldMs = Number.NEGATIVE_INFINITY;
  return {
    onFrame: (frame, rtpTimestamp) => tell({ receiver, type: 'frame', frame, rtpTimestamp }, [frame]),
    onDrop: ({ drops }) => {
      const nowMs = performance.now();
      if (nowMs < toldMs + TELL_DROPS_EVERY_MS) return;
      toldMs = nowMs;
      tell({ receiver, type: 'drops', drops: { ...drops } });
    },
    onUnsupported: (detail) => tell({ receiver, type: 'unsupported', detail }),
    // Refused while the receiver has no stream; then there is no frame either.
    requestKeyFrame: () => void transformer.sendKeyFrameRequest().catch(() => undefined),
    nowMs: () => performance.now(),
  };
}

function rtpTimestampOf(frame: RTCEncodedVideoFrame): number {
  return frame.getMetadata().rtpTimestamp ?? frame.timestamp;
}
