/** An operator for tests that finds its robot through the real signaling service. */

import {
  decodeJson,
  encodeJson,
  type OperatorToService,
  operatorToServiceCodec,
  PROTOCOL_VERSION,
  type ServiceToOperator,
  serviceToOperatorCodec,
  signalingEndpoint,
} from '@farpoint/protocol';
import { Waiters } from '@farpoint/service/testing/waiters';
import { WebSocket } from 'ws';
import { OperatorClient, type OperatorClientOptions } from './operator-client.ts';

/** What an operator shows with its first answer. */
export type Credentials = (facts: { session: string; offer: string; answer: string }) => Promise<{
  grant?: string | undefined;
  proof?: string | undefined;
}>;

export interface SignaledOperatorOptions extends OperatorClientOptions {
  credentials?: Credentials | undefined;
}

export class SignaledOperator {
  readonly client: OperatorClient;
  readonly #url: string;
  readonly #robotId: string;
  /** The newest socket. */
  #socket: WebSocket;
  readonly #sockets: WebSocket[] = [];
  readonly #log: ServiceToOperator[] = [];
  readonly #waiters = new Waiters();
  #session = '';
  /** `null` once it was shown. */
  #credentials: Credentials | null;

  private constructor(url: string, robotId: string, options: SignaledOperatorOptions = {}) {
    this.client = new OperatorClient(options);
    this.#credentials = options.credentials ?? null;
    this.#url = url;
    this.#robotId = robotId;
    this.#socket = this.#openSocket();
    this.client.onCandidate = (candidate) => {
      if (this.#session !== '') this.#send({ type: 'session.candidate', session: this.#session, candidate });
    };
  }

  /** Opens a session as soon as the robot is listed. Resolves once it is welcomed and can send commands. */
  static async connect(
    url: string,
    robotId: string,
    options?: SignaledOperatorOptions,
  ): Promise<SignaledOperator> {
    const operator = await SignaledOperator.open(url, robotId, options);
    await operator.client.ready();
    return operator;
  }

  /** Requests a session as soon as the robot is listed, and waits for nothing more. */
  static async open(
    url: string,
    robotId: string,
    options?: SignaledOperatorOptions,
  ): Promise<SignaledOperator> {
    const operator = new SignaledOperator(url, robotId, options);
    await operator.until(
      (message) =>
        (message.type === 'robots' && message.robots.some(({ id }) => id === robotId)) ||
        (message.type === 'robots.changed' && message.here.some(({ id }) => id === robotId)),
    );
    operator.#send({ type: 'session.open', robotId });
    return operator;
  }

  get session(): string {
    return this.#session;
  }

  /** All messages from the service. */
  get heard(): readonly ServiceToOperator[] {
    return this.#log;
  }

  /**
   * Requests an ICE restart from a new socket while the old one is still open. @param resumeKey defaults to the
   * robot's own
   */
  async resume(resumeKey?: string): Promise<void> {
    const own = (await this.client.message('welcome')).resumeKey ?? '';
    const welcomes = () => this.#log.filter(({ type }) => type === 'operator.welcome').length;
    const before = welcomes();
    this.#socket = this.#openSocket();
    await this.until(() => welcomes() > before);
    this.#send({
      type: 'session.resume',
      session: this.#session,
      robotId: this.#robotId,
      resumeKey: resumeKey ?? own,
    });
  }

  /** Resolves once a matching message has arrived. */
  until(is: (message: ServiceToOperator) => boolean): Promise<void> {
    return this.#waiters.until(() => this.#log.some(is));
  }

  closeSession(): void {
    this.#send({ type: 'session.close', session: this.#session });
  }

  /** Disappears without saying goodbye to signaling or to the robot. */
  async vanish(): Promise<void> {
    this.#socket.terminate();
    await this.client.vanish();
  }

  /** Ends the session on purpose, and says so. */
  leave(): void {
    this.#send({ type: 'session.close', session: this.#session });
  }

  async close(): Promise<void> {
    for (const socket of this.#sockets) socket.close();
    await this.client.close();
  }

  #openSocket(): WebSocket {
    const socket = new WebSocket(signalingEndpoint(this.#url, 'operator'));
    this.#sockets.push(socket);
    socket.on('open', () =>
      socket.send(
        encodeJson(operatorToServiceCodec, {
          type: 'operator.hello',
          protocol: PROTOCOL_VERSION,
          name: 'test operator',
        }),
      ),
    );
    socket.on('message', (data: Buffer) => {
      const message = decodeJson(serviceToOperatorCodec, data.toString());
      this.#log.push(message);
      void this.#onMessage(message);
      this.#waiters.changed();
    });
    return socket;
  }

  async #onMessage(message: ServiceToOperator): Promise<void> {
    if (message.type === 'session.opened') {
      this.#session = message.session;
    } else if (message.type === 'session.offer') {
      this.#session = message.session;
      const sdp = await this.client.answer(message.sdp);
      const { session } = message;
      const shown = await this.#credentials?.({ session, offer: message.sdp, answer: sdp });
      this.#credentials = null;
      this.#send({ type: 'session.answer', session, sdp, ...shown });
    } else if (message.type === 'session.candidate') {
      const { candidate, sdpMid, sdpMLineIndex } = message.candidate;
      await this.client.connection
        .addIceCandidate({
          candidate,
          ...(sdpMid == null ? {} : { sdpMid }),
          ...(sdpMLineIndex == null ? {} : { sdpMLineIndex }),
        })
        .catch(() => undefined);
    }
  }

  #send(message: OperatorToService): void {
    if (this.#socket.readyState === WebSocket.OPEN) {
      this.#socket.send(encodeJson(operatorToServiceCodec, message));
    }
  }
}
