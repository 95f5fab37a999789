import type { LocalStack } from '@farpoint/local-stack';
import { PROTOCOL_VERSION } from '@farpoint/protocol';
import { inTime, mustHold } from './harm.ts';
import { RawSocket } from './raw-socket.ts';

const ID = 'bystander';

/** Well-behaved users of the signaling service, in both protocols, who must notice nothing. */
export class Bystanders {
  readonly #stack: LocalStack;
  readonly #robot: RawSocket;
  readonly #operator: RawSocket;
  readonly #referenceRobot: RawSocket;
  readonly #referenceClient: RawSocket;
  readonly #referenceId: number;

  private constructor(
    stack: LocalStack,
    sockets: readonly [RawSocket, RawSocket, RawSocket, RawSocket],
    id: number,
  ) {
    this.#stack = stack;
    [this.#robot, this.#operator, this.#referenceRobot, this.#referenceClient] = sockets;
    this.#referenceId = id;
  }

  static async start(stack: LocalStack): Promise<Bystanders> {
    const { ports, signalingUrl } = stack;
    const robot = await RawSocket.open(`${signalingUrl}/robot`);
    robot.send({
      type: 'robot.hello',
      protocol: PROTOCOL_VERSION,
      id: ID,
      name: 'Bystander',
      key: 'bystander-key',
    });
    await robot.next('robot.welcome');
    const operator = await RawSocket.open(`${signalingUrl}/operator`);
    operator.send({ type: 'operator.hello', protocol: PROTOCOL_VERSION, name: 'Bystander' });
    await operator.next('operator.welcome');
    const client = await RawSocket.open(`ws://127.0.0.1:${ports.referenceClient}/`);
    const registered = await RawSocket.open(`ws://127.0.0.1:${ports.referenceRobot}/`);
    registered.send({ type: 'register', name: 'Bystander', sdpOffer: 'v=0' });
    const { robotId } = await registered.next('registered');
    return new Bystanders(stack, [robot, operator, registered, client], Number(robotId));
  }

  /** @throws {HarmError} unless sessions are introduced in both protocols as ever */
  async expectIntroductions(): Promise<void> {
    this.#operator.send({ type: 'session.open', robotId: ID });
    const { session } = await this.#operator.next('session.opened');
    await this.#robot.next('session.request');
    this.#robot.send({ type: 'session.offer', session, sdp: 'v=0 offer' });
    await this.#operator.next('session.offer');
    this.#operator.send({ type: 'session.answer', session, sdp: 'v=0 answer' });
    await this.#robot.next('session.answer');
    this.#operator.send({ type: 'session.close', session });
    await this.#robot.next('session.closed');
    const candidate = `candidate:${performance.now()}`;
    this.#referenceRobot.send({ type: 'candidate', robotId: this.#referenceId, candidate });
    for (;;) {
      const heard = await this.#referenceClient.next('candidate');
      if (heard.candidate === candidate) break;
      mustHold(heard.robotId !== this.#referenceId, 'a reference robot speaks with another one’s voice');
    }
    const health = await inTime(
      fetch(`http://127.0.0.1:${this.#stack.ports.signaling}/healthz`),
      'signaling does not answer',
    );
    mustHold(health.ok, 'signaling is not well');
  }

  close(): void {
    for (const socket of [this.#robot, this.#operator, this.#referenceRobot, this.#referenceClient])
      socket.close();
  }
}
