/** Reads the RTP payloads of VP8 frames (RFC 7741). */
import type { FrameBuffer } from './frame-buffer.ts';
import type { FrameKind, PayloadFault, PayloadReader } from './payload-reader.ts';
import { emptyVp8Descriptor, readVp8Descriptor } from './vp8-descriptor.ts';
import { readVp8FrameHeader } from './vp8-frame-header.ts';

export class Vp8Reader implements PayloadReader {
  readonly #descriptor = emptyVp8Descriptor();
  /** Whether the first payload of the frame has come, and its picture id. */
  #open = false;
  #pictureId = -1;

  reset(): void {
    this.#open = false;
  }

  beginsFrame(payload: Uint8Array): boolean {
    return readVp8Descriptor(payload, this.#descriptor) && this.#descriptor.beginsFrame;
  }

  append(payload: Uint8Array, frame: FrameBuffer): PayloadFault | null {
    const descriptor = this.#descriptor;
    if (!readVp8Descriptor(payload, descriptor) || descriptor.beginsFrame === this.#open) return 'malformed';
    if (!this.#open) this.#pictureId = descriptor.pictureId;
    else if (descriptor.pictureId !== this.#pictureId) return 'malformed';
    this.#open = true;
    return frame.append(payload.subarray(descriptor.bytes)) ? null : 'too-large';
  }

  finish(frame: Uint8Array): FrameKind | null {
    return readVp8FrameHeader(frame);
  }
}
