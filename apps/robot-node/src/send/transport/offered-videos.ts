import { VIDEO_CODECS, type VideoCodec, videoStreamId } from '@farpoint/protocol';
import { MediaStream, type RTCPeerConnection, type RTCRtpTransceiver } from 'werift';
import { unixOffsetMs } from '../../ground/wall-clock.ts';
import { type AnsweredVideo, readVideoAnswers } from './answered-codecs.ts';
import { videoCodecParameters } from './media-codecs.ts';
import type { VideoLine } from './peer-events.ts';
import { RtpTransportError, SrtpTransport } from './srtp-transport.ts';

const REFUSED: AnsweredVideo & { refusal: 'refused' } = { payloadTypes: new Map(), refusal: 'refused' };

/** The video m-lines of one connection: one for each camera that is streamed as video, in the order of their numbers. */
export class OfferedVideos {
  /** The codecs of each offered m-line. */
  readonly #offered: readonly (readonly VideoCodec[])[];
  readonly #transceivers: readonly RTCRtpTransceiver[];
  #answered: readonly AnsweredVideo[] | null = null;

  /** @param codecs of the videos, by number, each in the order of preference */
  constructor(connection: RTCPeerConnection, codecs: readonly (readonly VideoCodec[])[]) {
    this.#transceivers = codecs.map((each, video) => {
      const streams = [new MediaStream({ id: videoStreamId(video) })];
      const transceiver = connection.addTransceiver('video', { direction: 'sendonly', streams });
      transceiver.setCodecPreferences(each.map(videoCodecParameters));
      return transceiver;
    });
    // Even an idle video m-line in the bundle raises the browser's UDP receive buffer from 128 KiB to 2 MiB.
    if (codecs.length === 0) connection.addTransceiver('video', { direction: 'sendonly' });
    this.#offered = codecs.length === 0 ? [VIDEO_CODECS] : codecs;
  }

  /** How many m-lines were offered. */
  get lines(): number {
    return this.#offered.length;
  }

  /**
   * Reads the answer's codecs. Those of the first answer hold: an ICE restart changes none.
   *
   * @param sdp an answer with the offer's m-lines
   * @returns the answer without what cannot be used
   */
  read(sdp: string): string {
    const answer = readVideoAnswers(sdp, this.#offered);
    this.#answered ??= answer.videos;
    return answer.sdp;
  }

  /** Opens the lines that the operator accepted. Call it once DTLS has connected. */
  connect(): VideoLine[] {
    // Fixed for the session: a clock that is set meanwhile must not move pictures in time.
    const offsetMs = unixOffsetMs();
    return this.#transceivers.map((transceiver, video) => {
      const mid = transceiver.mid ?? '';
      const { payloadTypes, refusal } = this.#answered?.[video] ?? REFUSED;
      if (refusal !== null) return { ...REFUSED, mid, transport: null, refusal };
      try {
        const transport = new SrtpTransport(transceiver, {
          rtcp: false,
          unixOffsetMs: offsetMs,
          payloadTypes,
        });
        return { mid, transport, payloadTypes, refusal: null };
      } catch (error) {
        if (!(error instanceof RtpTransportError)) throw error;
        return { ...REFUSED, mid, transport: null };
      }
    });
  }
}
