import type { CaptureRoom, SourceFrame } from '@farpoint/cloud-source';
import { type CloudFormat, type Placement, stampUsOf } from '@farpoint/protocol';
import type { RejectedPoints } from '@farpoint/wasm-codec';

/** The paper's weights (equations 4 and 5). */
export interface SamplingOptions {
  lambda: number;
  epsilon: number;
  /** D, metres. */
  nearDistance: number;
  depthMeasure: 'z' | 'range';
}

/** Options for creating an encoder. */
export interface EncoderOptions extends SamplingOptions {
  /** The sensor's number, written to the placement. */
  sensor: number;
}

/** The result of encoding one frame. Its packets wait in the encoder. */
export interface EncodedFrame {
  format: CloudFormat;
  frameNumber: number;
  points: number;
  packets: number;
  /** Points of the raw cloud that could have been sent. */
  validPoints: number;
  rejected: RejectedPoints;
  saturated: number;
  /** Time to choose points and turn them into packets, ms. */
  sampleMs: number;
  packMs: number;
}

/** Holds a frame's packets until the next frame. */
export interface PacketSource {
  /** The codec's own memory. A frame that already lies there is not copied. */
  readonly room: CaptureRoom;
  /** Copies the packets of the last encoded frame out of the codec's memory. */
  copyPackets(into: Uint8Array, packets: number): void;
}

export function placementOf(
  frame: SourceFrame,
  format: CloudFormat,
  sensor: number,
  latencyTest: boolean,
  saturated: boolean,
): Placement {
  return {
    pose: frame.cameraPose,
    captureTimeUs: stampUsOf(frame.capturedAtMs),
    latencyTest,
    saturated,
    sensor,
    format,
  };
}

/**
 * Views of an encoder's memory, each created when it is first read. Creating the images may move the points view
 * created before, so read either points or images.
 */
export function roomOf(encoder: {
  frame: Float32Array;
  depth: Float32Array;
  colour: Uint32Array;
}): CaptureRoom {
  return {
    get points() {
      return encoder.frame;
    },
    get depth() {
      return encoder.depth;
    },
    get colour() {
      return encoder.colour;
    },
  };
}

export function isSameMemory(frame: ArrayBufferView, memory: ArrayBufferView): boolean {
  return frame.buffer === memory.buffer && frame.byteOffset === memory.byteOffset;
}
