import { SignaledOperator } from '@farpoint/robot-node/testing';
import { steadyHand } from '@farpoint/robot-node/testing/steady-hand';
import { inTime, mustHold, untilTrue } from './harm.ts';

/** In circles, so that there is always room. */
const TWIST = { linear: { x: 0.1, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.5 } };

/** Somebody who drives while others attack, and notices what happens to that. */
export class LiveDriver {
  readonly operator: SignaledOperator;
  readonly lease: string;
  readonly session: string;
  /** Every datagram sent since the last call of {@link record}. */
  #recorded: Buffer[] | null = null;
  readonly #letGo: () => void;

  private constructor(operator: SignaledOperator, lease: string) {
    this.operator = operator;
    this.lease = lease;
    this.session = operator.session;
    this.#letGo = steadyHand(operator.client, lease, TWIST);
    const { connection } = this;
    const send = connection.send;
    connection.send = (datagram: Buffer) => {
      this.#recorded?.push(Buffer.from(datagram));
      return send(datagram);
    };
  }

  static async start(signalingUrl: string, robotId: string): Promise<LiveDriver> {
    const operator = await inTime(
      SignaledOperator.connect(signalingUrl, robotId),
      'the driver gets no session',
    );
    const lease = await inTime(operator.client.takeLease(), 'the driver gets no lease');
    const driver = new LiveDriver(operator, lease);
    await inTime(
      operator.client.until(() => operator.client.telemetry?.drive === 'driving'),
      'the robot does not drive',
    );
    return driver;
  }

  /** Its ICE connection, from which an attacker who forges the driver's address would seem to send. */
  get connection() {
    const [transport] = this.operator.client.connection.iceTransports;
    if (transport === undefined) throw new Error('the driver has no transport');
    return transport.connection;
  }

  /** Where the robot receives from the driver. */
  get robotAddress(): readonly [host: string, port: number] {
    const { nominated } = this.connection;
    if (nominated === undefined) throw new Error('the driver has no path');
    return nominated.remoteAddr as [string, number];
  }

  /** Commands the same, and asks the robot to show it in a frame. */
  test(id: number): void {
    this.operator.client.drive(this.lease, 0.1, { twist: TWIST, latencyTest: id });
  }

  /** What the driver sends to the robot in the next `ms`, as somebody on the network sees it. */
  async record(ms: number): Promise<Buffer[]> {
    this.#recorded = [];
    await new Promise((resolve) => setTimeout(resolve, ms));
    const recorded = this.#recorded;
    this.#recorded = null;
    return recorded;
  }

  /** @throws {HarmError} unless the same session goes on: it has its lease, sees new frames, and is obeyed */
  async expectDriving(): Promise<void> {
    const { client } = this.operator;
    const sequence = client.telemetry?.sequence ?? 0;
    const frames = new Set(client.frames.keys());
    await untilTrue(
      () =>
        (client.telemetry?.sequence ?? 0) > sequence + 2 &&
        client.completeFrames.some(({ frameNumber }) => !frames.has(frameNumber)),
      'the driver hears nothing more from the robot',
    );
    // Attacks come from the driver's own thread, which may delay its commands for a moment.
    const obeyed = () =>
      client.telemetry?.drive === 'driving' && Math.abs(client.telemetry.twist.angular.z) > 0.1;
    await untilTrue(obeyed, 'the robot does not drive as it is told', 2000);
    mustHold(
      client.connection.connectionState === 'connected',
      'the driver’s connection has changed its state',
    );
    mustHold(this.operator.session === this.session, 'the driver has another session');
    const lease = client.session.findLast(({ type }) => type === 'lease');
    mustHold(lease?.type === 'lease' && lease.holder === 'you', 'the driver has lost the lease');
  }

  async close(): Promise<void> {
    this.#letGo();
    await this.operator.close();
  }
}
