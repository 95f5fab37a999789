import type { SignaledOperator } from '@farpoint/robot-node/testing';
import { sctpPacket } from '@farpoint/webrtc/testing';
import type { Scene } from './scene.ts';

interface Association {
  remoteVerificationTag: number;
  localTsn: number;
  lastReceivedTsn: number;
  send(stream: number, protocol: number, data: Buffer): Promise<void>;
  sendSack(): Promise<void>;
}

/** An operator with keys, which sends SCTP of its own. */
export class SctpGuest {
  readonly operator: SignaledOperator;

  private constructor(operator: SignaledOperator) {
    this.operator = operator;
  }

  static async join(scene: Scene): Promise<SctpGuest> {
    return new SctpGuest(await scene.guest());
  }

  get association(): Association {
    return this.operator.client.connection.sctpTransport?.sctp as unknown as Association;
  }

  get dtls() {
    const [transport] = this.operator.client.connection.dtlsTransports;
    if (transport === undefined) throw new Error('the guest has no transport');
    return transport;
  }

  /** Its ICE connection. */
  get ice() {
    return this.dtls.iceTransport.connection;
  }

  /** Bytes in a DTLS record. */
  async raw(...packets: readonly Buffer[]): Promise<void> {
    for (const packet of packets) await this.dtls.sendData(packet).catch(() => undefined);
  }

  /** Chunks as a packet of the association. */
  packet(...chunks: readonly number[]): Buffer {
    return sctpPacket(this.association.remoteVerificationTag, ...chunks);
  }

  async chunks(...chunks: readonly number[]): Promise<void> {
    await this.raw(this.packet(...chunks));
  }

  /** A message on any stream with any protocol. */
  message(stream: number, protocol: number, data: Buffer): void {
    this.association.send(stream, protocol, data).catch(() => undefined);
  }
}
