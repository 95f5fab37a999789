/** One picture of a video, taken out of its element, to be drawn later. */
export interface VideoImage {
  readonly image: VideoFrame | ImageBitmap;
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  /** The RTP timestamp of this very picture; `null` where the browser does not tell. */
  readonly rtpTimestamp: number | null;
  /** Call it once. Until then the picture takes one of the decoder's few buffers. */
  close(): void;
}

/**
 * Takes the picture that the element shows now; at once where the browser can, i.e. where it has `VideoFrame`.
 *
 * @param take called with the picture, or with `null` if there is none
 */
export function takeImage(video: HTMLVideoElement, take: (image: VideoImage | null) => void): void {
  if (typeof VideoFrame !== 'undefined') take(frameOf(video));
  else {
    createImageBitmap(video).then(
      (image) =>
        take({
          image,
          width: image.width,
          height: image.height,
          rtpTimestamp: null,
          close: () => image.close(),
        }),
      () => take(null),
    );
  }
}

function frameOf(video: HTMLVideoElement): VideoImage | null {
  try {
    const frame = new VideoFrame(video);
    const { displayWidth: width, displayHeight: height } = frame;
    return { image: frame, width, height, rtpTimestamp: rtpTimestampOf(frame), close: () => frame.close() };
  } catch {
    // The element has lost its picture, e.g. because its track has ended.
    return null;
  }
}

/** @returns `null` where the browser does not tell */
export function rtpTimestampOf(frame: VideoFrame): number | null {
  // Missing in some browsers, and in TypeScript's types.
  const { metadata } = frame as { metadata?: () => { rtpTimestamp?: unknown } };
  const rtpTimestamp = metadata?.call(frame).rtpTimestamp;
  return typeof rtpTimestamp === 'number' ? rtpTimestamp : null;
}
