/** Decodes a video, one picture after another. */
export class PictureDecoder {
  readonly #decoder: VideoDecoder;
  #decoded: PromiseWithResolvers<VideoFrame> | null = null;

  /** @param codec as WebCodecs names it */
  constructor(codec: string) {
    this.#decoder = new VideoDecoder({
      output: (frame) => {
        if (this.#decoded === null) frame.close();
        else this.#decoded.resolve(frame);
        this.#decoded = null;
      },
      error: (error) => this.#decoded?.reject(error),
    });
    this.#decoder.configure({ codec, optimizeForLatency: true });
  }

  decode(data: Uint8Array, key: boolean, timestamp: number): Promise<VideoFrame> {
    this.#decoded = Promise.withResolvers<VideoFrame>();
    this.#decoder.decode(new EncodedVideoChunk({ type: key ? 'key' : 'delta', timestamp, data }));
    return this.#decoded.promise;
  }

  close(): void {
    this.#decoder.close();
  }
}
