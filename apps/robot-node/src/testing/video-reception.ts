import {
  type AbsCaptureTime,
  readAbsCaptureTime,
  VideoDepacketiser,
  type WholeVideoFrame,
} from '@farpoint/rtp';
import type { MediaStreamTrack, RTCPeerConnection } from 'werift';

/** What has been received of one camera. */
export interface ReceivedVideo {
  /** Of the newest packet. */
  captureTime: AbsCaptureTime | null;
  /** Whole frames, in order. */
  readonly frames: WholeVideoFrame[];
  readonly depacketiser: VideoDepacketiser;
}

/** The videos of a connection, by the `mid` of their m-lines. */
export class VideoReception {
  readonly videos = new Map<string, ReceivedVideo>();
  readonly #connection: RTCPeerConnection;
  readonly #onPacket: () => void;

  /** @param onPacket called after each packet */
  constructor(connection: RTCPeerConnection, onPacket: () => void) {
    this.#connection = connection;
    this.#onPacket = onPacket;
  }

  add(track: MediaStreamTrack): void {
    track.onReceiveRtp.subscribe(({ header, payload }) => {
      const transceiver = this.#connection.getTransceivers().find(({ receiver }) => receiver.track === track);
      const mid = transceiver?.mid ?? '';
      const video = this.videos.get(mid) ?? {
        frames: [],
        depacketiser: new VideoDepacketiser(track.codec?.name.toLowerCase() === 'h264' ? 'h264' : 'vp8'),
        captureTime: null,
      };
      this.videos.set(mid, video);
      // The only element of this length.
      const captureTime = header.extensions.find((element) => element.payload.length === 8);
      if (captureTime !== undefined) video.captureTime = readAbsCaptureTime(captureTime.payload);
      const { sequenceNumber, timestamp, marker } = header;
      const frame = video.depacketiser.take(sequenceNumber, timestamp, marker, payload);
      if (frame !== null) video.frames.push(frame);
      this.#onPacket();
    });
  }
}
