/** A picture of the camera that a cloud comes from: of its lens, and from its place. */
export interface CameraPicture {
  /** Of this width and height. */
  readonly image: TexImageSource;
  /** Pixels. */
  readonly width: number;
  /** Pixels. */
  readonly height: number;
}

/** What becomes of a picture. */
export type PictureUse =
  /** It paints its frame, which had come before. */
  | 'matched'
  /** It is kept: its frame may still come. */
  | 'early'
  /** The cloud is not drawn as a surface. */
  | 'no-surface'
  /** No frame of the cloud was captured with it. */
  | 'between-frames'
  /** Its sides have another ratio than the cloud's grid. */
  | 'other-shape'
  /** It is larger than there is memory for. */
  | 'too-large'
  /** This browser takes no such picture as a texture. */
  | 'unreadable';

/**
 * Paints the surface with pictures of its camera, e.g. a video's, instead of the packets' colours. A frame is painted only
 * with the picture of its own capture instant; without one, it has the packets' colours. Instants are in µs on the
 * robot's clock, modulo 2³², like `Batch.captureTimeUs`.
 */
export interface CloudPaint {
  /** Whether pictures paint; default: yes. */
  on: boolean;
  /** How much of the colours pictures give at present, 0–1: that of the newest frame, as a mean over half a second. */
  readonly share: number;
  /** Frames that a newer one has followed, and how many of those a picture painted by then. */
  readonly frames: {
    /** Since the view was made. */
    readonly followed: number;
    /** Of these. */
    readonly painted: number;
  };
  /**
   * Tells of a frame that has come, if it is drawn only later. Pictures between the frames are then not kept for nothing.
   *
   * @param instantUs when it was captured
   */
  expect(instantUs: number): void;
  /**
   * Takes a picture. It is copied at once, and may be closed afterwards.
   *
   * @param instantUs when it was captured
   */
  take(picture: CameraPicture, instantUs: number): PictureUse;
}
