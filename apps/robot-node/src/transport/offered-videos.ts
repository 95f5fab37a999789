import { type VideoCodec, videoStreamId } from '@farpoint/protocol';
import { MediaStream, type RTCPeerConnection, type RTCRtpTransceiver } from 'werift';
import { monotonicMs } from '../clock.ts';
import { videoCodecParameters } from './media-codecs.ts';
import { RtpTransportError, SrtpTransport } from './srtp-transport.ts';
import type { VideoLine } from './video-line.ts';

/** The video m-lines of one connection: one for each camera that is streamed as video, in the order of their numbers. */
export class OfferedVideos {
  /** How many m-lines were offered. */
  readonly lines: number;
  readonly #transceivers: readonly RTCRtpTransceiver[];

  /** @param codecs of the videos, by number */
  constructor(connection: RTCPeerConnection, codecs: readonly VideoCodec[]) {
    this.#transceivers = codecs.map((codec, video) => {
      const streams = [new MediaStream({ id: videoStreamId(video) })];
      const transceiver = connection.addTransceiver('video', { direction: 'sendonly', streams });
      transceiver.setCodecPreferences([videoCodecParameters(codec)]);
      return transceiver;
    });
    // Even an idle video m-line in the bundle raises the browser's UDP receive buffer from 128 KiB to 2 MiB.
    if (codecs.length === 0) connection.addTransceiver('video', { direction: 'sendonly' });
    this.lines = Math.max(codecs.length, 1);
  }

  /** Opens the lines that the operator accepted. Call it once DTLS has connected. */
  connect(): VideoLine[] {
    // Fixed for the session: a clock that is set meanwhile must not move pictures in time.
    const unixOffsetMs = performance.timeOrigin + performance.now() - monotonicMs();
    return this.#transceivers.map((transceiver) => {
      const mid = transceiver.mid ?? '';
      try {
        return { mid, transport: new SrtpTransport(transceiver, { rtcp: false, unixOffsetMs }) };
      } catch (error) {
        if (!(error instanceof RtpTransportError)) throw error;
        return { mid, transport: null };
      }
    });
  }
}
