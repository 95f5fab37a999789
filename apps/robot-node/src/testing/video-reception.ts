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
  /** Of the newest packet: with the codec it may change, from a key frame on. */
  payloadType: number;
  depacketiser: VideoDepacketiser;
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
      const video: ReceivedVideo = this.videos.get(mid) ?? {
        ...{ frames: [], depacketiser: new VideoDepacketiser('vp8'), captureTime: null, payloadType: -1 },
      };
      this.videos.set(mid, video);
      if (header.payloadType !== video.payloadType) {
        video.payloadType = header.payloadType;
        const codec = transceiver?.codecs.find(({ payloadType }) => payloadType === header.payloadType);
        video.depacketiser = new VideoDepacketiser(codec?.name.toLowerCase() === 'h264' ? 'h264' : 'vp8');
      }
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
