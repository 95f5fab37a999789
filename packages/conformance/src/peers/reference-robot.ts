/** A robot for tests that speaks as the reference system's does: signaling, channels, payload type 5. */
import { once } from 'node:events';
import { decodeBandwidth, decodeJson, referenceControlCodec, type Twist } from '@farpoint/protocol';
import { createReferencePeerConnection, referenceChannels } from '@farpoint/reference-profile';
import { MediaStreamTrack, type RTCPeerConnection, RtpHeader, RtpPacket } from 'werift';
import { WebSocket } from 'ws';

export class ReferenceRobot {
  id = -1;
  readonly #socket: WebSocket;
  readonly #connection: RTCPeerConnection;
  readonly #track = new MediaStreamTrack({ kind: 'video' });
  readonly #words: string[] = [];
  readonly #commands: Twist[] = [];
  readonly #reports: number[] = [];
  readonly #waiting = new Set<() => void>();
  #sequence = 0;

  private constructor(url: string) {
    this.#socket = new WebSocket(url);
    this.#connection = createReferencePeerConnection();
    const connection = this.#connection;
    connection.addTransceiver(this.#track, { direction: 'sendonly' });
    const control = connection.createDataChannel(referenceChannels.control.label, { ordered: true });
    control.onMessage.subscribe((data) => {
      this.#commands.push(decodeJson(referenceControlCodec, data));
      this.#wake();
    });
    connection.onDataChannel.subscribe((channel) => {
      channel.onMessage.subscribe((data) => {
        if (channel.label === 'bandwidth') this.#reports.push(decodeBandwidth(data as Buffer));
        else this.#words.push(data.toString());
        this.#wake();
      });
    });
  }

  /** Its offer, for others to claim. */
  get offer(): string {
    return this.#connection.localDescription?.sdp ?? '';
  }

  static async register(url: string, name: string): Promise<ReferenceRobot> {
    const robot = new ReferenceRobot(url);
    const connection = robot.#connection;
    await once(robot.#socket, 'open');
    const offer = await connection.createOffer();
    const registered = new Promise<void>((resolve) => {
      robot.#socket.on('message', (data: Buffer) => {
        const message = JSON.parse(data.toString('utf8'));
        if (message.type === 'registered') {
          robot.id = message.robotId;
          resolve();
        } else if (message.type === 'sdpAnswer') {
          void connection.setRemoteDescription({ type: 'answer', sdp: message.sdpAnswer }).catch(() => {});
        } else if (message.type === 'candidate') {
          void connection.addIceCandidate({ candidate: message.candidate, sdpMLineIndex: 0 }).catch(() => {});
        }
      });
    });
    const found: string[] = [];
    connection.onIceCandidate.subscribe((candidate) => {
      if (candidate === undefined) return;
      const text = candidate.toJSON().candidate;
      if (robot.id < 0) found.push(text);
      else robot.signal({ type: 'candidate', robotId: robot.id, candidate: text });
    });
    const gathered = connection.setLocalDescription(offer);
    robot.signal({ type: 'register', name, sdpOffer: offer.sdp });
    await registered;
    for (const candidate of found) robot.signal({ type: 'candidate', robotId: robot.id, candidate });
    await gathered;
    return robot;
  }

  signal(message: unknown): void {
    if (this.#socket.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(message));
  }

  /** Resolves once this word came; words before it are forgotten. */
  async heard(word: 'start' | 'stop'): Promise<void> {
    while ((await this.#next(this.#words)) !== word);
  }

  command(): Promise<Twist> {
    return this.#next(this.#commands);
  }

  report(): Promise<number> {
    return this.#next(this.#reports);
  }

  sendFrame(payloads: Buffer[]): void {
    payloads.forEach((payload, i) => {
      const header = new RtpHeader({
        payloadType: 5,
        sequenceNumber: this.#sequence++ & 0xffff,
        timestamp: 0,
        marker: i === payloads.length - 1,
      });
      this.#track.writeRtp(new RtpPacket(header, payload));
    });
  }

  async close(): Promise<void> {
    this.#socket.close();
    await this.#connection.close();
  }

  async #next<T>(queue: T[]): Promise<T> {
    for (;;) {
      const item = queue.shift();
      if (item !== undefined) return item;
      await new Promise<void>((resolve) => this.#waiting.add(resolve));
    }
  }

  #wake(): void {
    for (const resolve of this.#waiting) resolve();
    this.#waiting.clear();
  }
}
