/** Decodes one video: takes its encoded frames, and hands on the pictures. */
import type { VideoCodec } from '@farpoint/operator';
import { DecodeGate } from './decode-gate.ts';

export interface VideoDecodingPort {
  /** Whoever takes the frame closes it. */
  onFrame(frame: VideoFrame, rtpTimestamp: number): void;
  /** Frames were dropped; the gate has the counts. */
  onDrop(gate: DecodeGate): void;
  /** This browser's decoder refuses the video. */
  onUnsupported(detail: string): void;
  /** Asks the robot for a key frame. */
  requestKeyFrame(): void;
  nowMs(): number;
}

export class VideoDecoding {
  readonly #port: VideoDecodingPort;
  readonly #gate: DecodeGate;
  #decoder: VideoDecoder | null = null;
  #ended = false;

  constructor(codec: VideoCodec, port: VideoDecodingPort) {
    this.#port = port;
    this.#gate = new DecodeGate(codec);
  }

  /** Ends decoding; nothing is handed on any more. */
  close(): void {
    this.#ended = true;
    this.#drop('closed');
  }

  /** Takes the next frame. Its bytes are no longer needed when this returns. */
  take({ type, data }: RTCEncodedVideoFrame, rtpTimestamp: number): void {
    if (this.#ended) return;
    const bytes = new Uint8Array(data);
    const decision = this.#gate.decide(
      { isKey: type === 'key', rtpTimestamp, bytes },
      this.#decoder?.decodeQueueSize ?? 0,
    );
    if (decision.decode) {
      if (decision.configure !== null) this.#configure(decision.configure);
      this.#decode(bytes, decision.isKey, decision.ticks);
    } else this.#port.onDrop(this.#gate);
    if (this.#gate.asksForKey(this.#port.nowMs())) this.#port.requestKeyFrame();
  }

  #configure(codec: string): void {
    const decoder = this.#decoder ?? this.#newDecoder();
    this.#decoder = decoder;
    // Annex B needs no description. What is best is the browser's to say: hardware has its own delay and few sessions.
    decoder.configure({ codec, optimizeForLatency: true, hardwareAcceleration: 'no-preference' });
  }

  #newDecoder(): VideoDecoder {
    const decoder: VideoDecoder = new VideoDecoder({
      output: (frame) => {
        // The lower 32 bits of the unwrapped timestamp.
        if (decoder === this.#decoder) this.#port.onFrame(frame, frame.timestamp >>> 0);
        else frame.close();
      },
      error: (error) => {
        if (decoder === this.#decoder) this.#fail(error);
      },
    });
    return decoder;
  }

  #decode(data: Uint8Array<ArrayBuffer>, isKey: boolean, ticks: number): void {
    try {
      // The decoder only hands the timestamp on, so it need not be in µs.
      this.#decoder?.decode(new EncodedVideoChunk({ type: isKey ? 'key' : 'delta', timestamp: ticks, data }));
    } catch (error) {
      this.#fail(error);
    }
  }

  #fail(error: unknown): void {
    if (error instanceof DOMException && error.name === 'NotSupportedError') {
      this.close();
      this.#port.onUnsupported(error.message);
      return;
    }
    this.#drop('failed');
    this.#port.onDrop(this.#gate);
    if (this.#gate.asksForKey(this.#port.nowMs())) this.#port.requestKeyFrame();
  }

  #drop(reason: 'failed' | 'closed'): void {
    const decoder = this.#decoder;
    this.#decoder = null;
    if (decoder !== null && decoder.state !== 'closed') decoder.close();
    this.#gate.restart(reason);
  }
}
