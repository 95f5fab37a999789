/**
 * Videos of a scripted robot: pictures that a script makes come where the browser would hand over those that it has
 * decoded. Everything behind that is the page's own.
 */
import type { ScriptedLink } from '@farpoint/operator/testing/scripted-link';
import { VIDEO_CLOCK_RATE } from '@farpoint/protocol';

const TICKS_PER_MS = VIDEO_CLOCK_RATE / 1000;

export type Rgb = readonly [red: number, green: number, blue: number];

export interface PictureOptions {
  /** Default: white. */
  colour?: Rgb;
  /** Of its quarters instead: at the top left, at the top right, at the bottom left, at the bottom right. */
  quarters?: readonly [Rgb, Rgb, Rgb, Rgb];
  /** How long before now it was captured, ms. */
  ageMs?: number;
  /** Pixels; default: 320 × 240. */
  width?: number;
  height?: number;
}

export class ScriptedVideos {
  /** What the page reads at present, by track. */
  readonly #readers = new Map<MediaStreamTrack, ReadableStreamDefaultController<VideoFrame>>();
  /** Gives tracks; it never connects. */
  readonly #connection = new RTCPeerConnection();
  /** The tracks of the session, by video. */
  readonly #tracks = new Map<number, MediaStreamTrack>();
  #session: ScriptedLink['session'] | null = null;

  /** Takes the place of what reads the browser's decoded pictures. Call it before the page looks for that. */
  install(): void {
    const readableOf = (track: MediaStreamTrack) => this.#readableOf(track);
    Object.assign(globalThis, {
      MediaStreamTrackProcessor: class {
        readonly readable: ReadableStream<VideoFrame>;
        constructor({ track }: { track: MediaStreamTrack }) {
          this.readable = readableOf(track);
        }
      },
    });
  }

  /**
   * The track of a video comes, once in each session.
   *
   * @param refused whether the browser has refused the video, e.g. for its codec
   */
  offer(link: ScriptedLink, video: number, refused = false): MediaStreamTrack {
    if (this.#session !== link.session) this.#tracks.clear();
    this.#session = link.session;
    const known = this.#tracks.get(video);
    if (known !== undefined) return known;
    const { receiver } = this.#connection.addTransceiver('video');
    const { track } = receiver;
    if (refused) track.stop();
    this.#tracks.set(video, track);
    link.offerVideo({ video, track, receiver });
    return track;
  }

  /** A picture is decoded. @param robotMs the robot's clock @returns whether the page reads the video */
  show(track: MediaStreamTrack, picture: PictureOptions, robotMs: number): boolean {
    const reader = this.#readers.get(track);
    const captureMs = robotMs - (picture.ageMs ?? 0);
    reader?.enqueue(frameOf(picture, Math.round(captureMs * TICKS_PER_MS) >>> 0));
    return reader !== undefined;
  }

  #readableOf(track: MediaStreamTrack): ReadableStream<VideoFrame> {
    return new ReadableStream({
      start: (controller) => void this.#readers.set(track, controller),
      cancel: () => void this.#readers.delete(track),
    });
  }
}

function frameOf(picture: PictureOptions, rtpTimestamp: number): VideoFrame {
  const { colour = [255, 255, 255], width = 320, height = 240 } = picture;
  const { quarters = [colour, colour, colour, colour] } = picture;
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('this browser draws no pictures');
  for (const [i, quarter] of quarters.entries()) {
    context.fillStyle = `rgb(${quarter.join(' ')})`;
    context.fillRect(((i % 2) * width) / 2, (Math.floor(i / 2) * height) / 2, width / 2, height / 2);
  }
  const frame = new VideoFrame(canvas, { timestamp: 0 });
  // Only what has come by RTP has it of itself.
  Object.defineProperty(frame, 'metadata', { value: () => ({ rtpTimestamp }) });
  return frame;
}
