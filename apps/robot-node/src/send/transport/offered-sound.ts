import { SOUND_MEDIA, SOUND_STREAM_ID } from '@farpoint/protocol';
import { MediaStream, type RTCPeerConnection, type RTCRtpTransceiver, RTP_EXTENSION_URI } from 'werift';
import { monotonicMs } from '../../ground/clock.ts';
import { unixOffsetMs } from '../../ground/wall-clock.ts';
import type { SoundLine } from './peer-events.ts';
import { RtpTransportError, SrtpTransport } from './srtp-transport.ts';
import { VoiceReceiver } from './voice-receiver.ts';

/** The m-line of one connection for the robot's microphone and the operator's voice. */
export class OfferedSound {
  readonly #transceiver: RTCRtpTransceiver;

  constructor(connection: RTCPeerConnection) {
    const streams = [new MediaStream({ id: SOUND_STREAM_ID })];
    this.#transceiver = connection.addTransceiver(SOUND_MEDIA.kind, { direction: 'sendrecv', streams });
  }

  /** Opens the line, if the operator accepted it. Call it once DTLS has connected. */
  connect(): SoundLine {
    const { dtlsTransport, headerExtensions, sender } = this.#transceiver;
    const mid = this.#transceiver.mid ?? '';
    try {
      const transport = new SrtpTransport(this.#transceiver, { rtcp: false, unixOffsetMs: unixOffsetMs() });
      const voice = new VoiceReceiver(dtlsTransport, {
        payloadType: sender.codec?.payloadType ?? -1,
        transportSequenceId:
          headerExtensions.find(({ uri }) => uri === RTP_EXTENSION_URI.transportWideCC)?.id ?? 0,
        now: monotonicMs,
      });
      return { mid, transport, voice };
    } catch (error) {
      if (!(error instanceof RtpTransportError)) throw error;
      return { mid, transport: null, voice: null };
    }
  }
}
