/** Detects whether and how this browser lets a worker take a receiver's encoded frames. */
import type { CloudTransformOptions, ToCloudWorker } from '../cloud/worker-messages.ts';

/** How this browser hands a receiver's encoded frames to a worker. */
export type TransformSupport =
  /** RTCRtpScriptTransform: WebRTC Encoded Transform. */
  | 'script-transform'
  /** CreateEncodedStreams: Chromium before 2025, Quest browsers before 42. */
  | 'encoded-streams'
  | 'none';

interface EncodedStreamsReceiver extends RTCRtpReceiver {
  createEncodedStreams(): { readable: ReadableStream<RTCEncodedAudioFrame>; writable: WritableStream };
}

/** Tells how this browser hands encoded frames to a worker. With `none` it cannot receive clouds. */
export function transformSupport(): TransformSupport {
  if (typeof RTCRtpReceiver === 'undefined') return 'none';
  if (typeof RTCRtpScriptTransform !== 'undefined') return 'script-transform';
  return 'createEncodedStreams' in RTCRtpReceiver.prototype ? 'encoded-streams' : 'none';
}

/** Options that the peer connection needs. */
export function transformConfiguration(support: TransformSupport): RTCConfiguration {
  // No longer in the standard, so missing in the types.
  return support === 'encoded-streams' ? ({ encodedInsertableStreams: true } as RTCConfiguration) : {};
}

/** Hands the receiver's frames to the worker. Call it synchronously in `ontrack`, or the first frames are lost. */
export function attachWorker(
  receiver: RTCRtpReceiver,
  worker: Worker,
  support: TransformSupport,
  generation: number,
): void {
  if (support === 'script-transform') {
    const options: CloudTransformOptions = { generation };
    receiver.transform = new RTCRtpScriptTransform(worker, options);
  } else if (support === 'encoded-streams') {
    const { readable } = (receiver as EncodedStreamsReceiver).createEncodedStreams();
    const message: ToCloudWorker = { type: 'stream', readable, generation };
    worker.postMessage(message, [readable]);
  }
}
