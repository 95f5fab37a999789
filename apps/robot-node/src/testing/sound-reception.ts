import type { MediaStreamTrack, RTCPeerConnection, RTCRtpTransceiver } from 'werift';

/** A packet of the robot's microphone. */
export interface ReceivedSound {
  readonly sequence: number;
  readonly timestamp: number;
  readonly marker: boolean;
  readonly payload: Uint8Array;
}

/** A connection's m-line for sound: the second one with audio. */
export class SoundReception {
  readonly packets: ReceivedSound[] = [];
  readonly #connection: RTCPeerConnection;
  readonly #onPacket: () => void;
  #sent = 0;

  /** @param onPacket called after each packet */
  constructor(connection: RTCPeerConnection, onPacket: () => void) {
    this.#connection = connection;
    this.#onPacket = onPacket;
  }

  get transceiver(): RTCRtpTransceiver | undefined {
    return this.#connection.getTransceivers().filter(({ kind }) => kind === 'audio')[1];
  }

  /** Offers to speak as well. Call it before the answer is made. */
  acceptBoth(): void {
    this.transceiver?.setDirection('sendrecv');
  }

  /** @returns whether the track is that of sound */
  add(track: MediaStreamTrack): boolean {
    if (this.transceiver?.receiver.track !== track) return false;
    track.onReceiveRtp.subscribe(({ header, payload }) => {
      const { sequenceNumber: sequence, timestamp, marker } = header;
      this.packets.push({ sequence, timestamp, marker, payload });
      this.#onPacket();
    });
    return true;
  }

  /** Sends 20 ms of a voice. @param step of the sequence number: more than 1 leaves a gap */
  speak(opus: Uint8Array, step = 1): void {
    this.#sent += step;
    const header = Buffer.alloc(12);
    header[0] = 0x80;
    header.writeUInt16BE(this.#sent & 0xffff, 2);
    header.writeUInt32BE((this.#sent * 960) >>> 0, 4);
    void this.transceiver?.sender.sendRtp(Buffer.concat([header, opus]));
  }
}
