/** An operator for tests that finds its robot through the real signaling service. */
import {
  decodeJson,
  encodeJson,
  type OperatorToService,
  operatorToServiceCodec,
  PROTOCOL_VERSION,
  type ServiceToOperator,
  serviceToOperatorCodec,
} from '@farpoint/protocol';
import { WebSocket } from 'ws';
import { OperatorClient, type OperatorClientOptions } from './operator-client.ts';

export class SignaledOperator {
  readonly client: OperatorClient;
  readonly #socket: WebSocket;
  readonly #log: ServiceToOperator[] = [];
  readonly #waiters = new Set<() => void>();
  #session = '';

  private constructor(url: string, options?: OperatorClientOptions) {
    this.client = new OperatorClient(options);
    this.#socket = new WebSocket(new URL('/operator', url));
    this.#socket.on('open', () =>
      this.#send({ type: 'operator.hello', protocol: PROTOCOL_VERSION, name: 'test operator' }),
    );
    this.#socket.on('message', (data: Buffer) => {
      const message = decodeJson(serviceToOperatorCodec, data.toString());
      this.#log.push(message);
      void this.#onMessage(message);
      for (const look of [...this.#waiters]) look();
    });
    this.client.onCandidate = (candidate) => {
      if (this.#session !== '') this.#send({ type: 'session.candidate', session: this.#session, candidate });
    };
  }

  /** Opens a session as soon as the robot is listed; resolves once it is welcomed and can send commands. */
  static async connect(
    url: string,
    robotId: string,
    options?: OperatorClientOptions,
  ): Promise<SignaledOperator> {
    const operator = await SignaledOperator.open(url, robotId, options);
    await operator.client.ready();
    return operator;
  }

  /** Asks for a session as soon as the robot is listed, and waits for nothing more. */
  static async open(
    url: string,
    robotId: string,
    options?: OperatorClientOptions,
  ): Promise<SignaledOperator> {
    const operator = new SignaledOperator(url, options);
    await operator.until(
      (message) =>
        (message.type === 'robots' && message.robots.some(({ id }) => id === robotId)) ||
        (message.type === 'robots.changed' && message.here.some(({ id }) => id === robotId)),
    );
    operator.#send({ type: 'session.open', robotId });
    return operator;
  }

  /** Resolves once such a message has come. */
  until(is: (message: ServiceToOperator) => boolean): Promise<void> {
    return new Promise((resolve) => {
      const look = () => {
        if (!this.#log.some(is)) return;
        this.#waiters.delete(look);
        resolve();
      };
      this.#waiters.add(look);
      look();
    });
  }

  closeSession(): void {
    this.#send({ type: 'session.close', session: this.#session });
  }

  /** Goes without a word: no goodbye to signaling, none to the robot. */
  async vanish(): Promise<void> {
    this.#socket.terminate();
    await this.client.vanish();
  }

  async close(): Promise<void> {
    this.#socket.close();
    await this.client.close();
  }

  async #onMessage(message: ServiceToOperator): Promise<void> {
    if (message.type === 'session.opened') {
      this.#session = message.session;
    } else if (message.type === 'session.offer') {
      this.#session = message.session;
      const sdp = await this.client.answer(message.sdp);
      this.#send({ type: 'session.answer', session: message.session, sdp });
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
