/**
 * What Farpoint's own page sends on a bridge's three sockets (apps/webxr, bridge-session.ts, whose tests check this):
 * `initBridge` if it is given a signaling service, else `updateRobots`. It chooses robots by name, treats a switched
 * robot as shown only if the list contains it, and sends its commands at 50 Hz.
 */
import { type Twist, zeroTwist } from '@farpoint/protocol';
import { SocketPeer } from '../peers/socket-peer.ts';
import type { BridgeSockets, ListedRobot } from './released-page.ts';

type List = { robots: ListedRobot[] | null };

const COMMAND_INTERVAL_MS = 20;

export class FarpointPage {
  readonly errors: string[] = [];
  readonly #bridge: BridgeSockets;
  readonly #signalingUrl: string | null;
  #control!: SocketPeer;
  #telemetry!: SocketPeer;
  #streaming!: SocketPeer;
  #timer: NodeJS.Timeout | null = null;
  #wish = zeroTwist();

  private constructor(bridge: BridgeSockets, signalingUrl: string | null) {
    this.#bridge = bridge;
    this.#signalingUrl = signalingUrl;
  }

  static async load(bridge: BridgeSockets, signalingUrl: string | null): Promise<FarpointPage> {
    const page = new FarpointPage(bridge, signalingUrl);
    await page.reload();
    return page;
  }

  async reload(): Promise<void> {
    await this.close();
    this.#control = await SocketPeer.open(this.#bridge.control);
    this.#telemetry = await SocketPeer.open(this.#bridge.telemetry);
    this.#streaming = await SocketPeer.open(this.#bridge.streaming);
    if (this.#signalingUrl === null) this.#control.send({ type: 'updateRobots' });
    else this.#control.send({ type: 'initBridge', url: this.#signalingUrl });
    this.#wish = zeroTwist();
    this.#timer = setInterval(
      () => this.#telemetry.send({ type: 'command', command: this.#wish }),
      COMMAND_INTERVAL_MS,
    );
  }

  async switchTo(name: string): Promise<void> {
    this.#control.send({ type: 'updateRobots' });
    for (;;) {
      const { robots } = await this.#control.message<List>({ type: 'updateRobots' });
      const robot = robots?.find((listed) => listed.name === name);
      if (robot === undefined) continue;
      this.#control.send({ type: 'switchRobot', robotId: robot.id });
      await this.#control.message({ type: 'switchedRobot', robotId: robot.id });
      return;
    }
  }

  /** The commanded velocity from now on; a latency test is requested once. */
  command(twist: Twist): void {
    if (twist.linear.z === 0) this.#wish = twist;
    else this.#telemetry.send({ type: 'command', command: twist });
  }

  /** The next message of the streaming socket. */
  points(): Promise<Uint8Array> {
    return this.#streaming.bytes();
  }

  async close(): Promise<void> {
    if (this.#timer !== null) clearInterval(this.#timer);
    for (const socket of [this.#control, this.#telemetry, this.#streaming] as (SocketPeer | undefined)[])
      await socket?.close();
  }
}
