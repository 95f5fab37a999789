/**
 * Stand-in for the reference system's released page, with its actual behaviour on a bridge's three sockets, including
 * defects:
 *
 * - at its first load and after each reload it sends `initBridge`, always with the same address, and nothing else until
 *   somebody selects a robot;
 * - it takes the list as it arrives, including `null`, and selects by a robot's position in it;
 * - it looks up a switched robot in its list: `switchedRobot` breaks its handler if the list is `null`, and shows no
 *   robot if the list does not contain it.
 */
import type { Twist } from '@farpoint/protocol';
import { Inbox } from '../peers/inbox.ts';
import { SocketPeer } from '../peers/socket-peer.ts';

export interface BridgeSockets {
  control: string;
  telemetry: string;
  streaming: string;
}

export interface ListedRobot {
  id: number;
  name: string;
}

type Message = { type: string; robots: ListedRobot[] | null; robotId: number };

export class ReleasedPage {
  robots: ListedRobot[] | null = [];
  selected: ListedRobot | null = null;
  /** Errors in its handlers. */
  readonly errors: string[] = [];
  /** Messages of the control socket, each after it was handled. */
  readonly handled = new Inbox<Message>();
  readonly #bridge: BridgeSockets;
  readonly #signalingUrl: string;
  #control!: SocketPeer;
  #telemetry!: SocketPeer;
  #streaming!: SocketPeer;

  private constructor(bridge: BridgeSockets, signalingUrl: string) {
    this.#bridge = bridge;
    this.#signalingUrl = signalingUrl;
  }

  /** @param origin of the server that the page comes from */
  static async load(
    bridge: BridgeSockets,
    signalingUrl: string,
    origin = 'http://localhost:5173',
  ): Promise<ReleasedPage> {
    const page = new ReleasedPage(bridge, signalingUrl);
    await page.reload(origin);
    return page;
  }

  async reload(origin?: string): Promise<void> {
    await this.close();
    this.robots = [];
    this.selected = null;
    this.#control = await SocketPeer.open(this.#bridge.control, origin);
    this.#control.send({ type: 'initBridge', url: this.#signalingUrl });
    this.#telemetry = await SocketPeer.open(this.#bridge.telemetry, origin);
    this.#streaming = await SocketPeer.open(this.#bridge.streaming, origin);
    void this.#follow(this.#control);
  }

  /** The robot with this name, once it is listed. */
  async listed(name: string): Promise<ListedRobot> {
    for (;;) {
      const found = this.robots?.find((robot) => robot.name === name);
      if (found !== undefined) return found;
      await this.handled.next(
        ({ type }) => type === 'updateRobots',
        undefined,
        `robot '${name}' in the list`,
      );
    }
  }

  async switchTo(name: string): Promise<void> {
    const { id } = await this.listed(name);
    this.#control.send({ type: 'switchRobot', robotId: id });
    await this.handled.next(
      ({ type, robotId }) => type === 'switchedRobot' && robotId === id,
      undefined,
      `switchedRobot ${id}`,
    );
  }

  command(command: Twist): void {
    this.#telemetry.send({ type: 'command', command });
  }

  /** The next message of the streaming socket. */
  points(): Promise<Uint8Array> {
    return this.#streaming.bytes();
  }

  async close(): Promise<void> {
    for (const socket of [this.#control, this.#telemetry, this.#streaming] as (SocketPeer | undefined)[])
      await socket?.close();
  }

  async #follow(control: SocketPeer): Promise<void> {
    while (control.open) {
      const message = await control.message<Message>({}, 60_000).catch(() => null);
      if (message === null || control !== this.#control) return;
      try {
        this.#handle(message);
      } catch (error) {
        this.errors.push(String(error));
      }
      this.handled.push(message);
    }
  }

  #handle({ type, robots, robotId }: Message): void {
    if (type === 'updateRobots') this.robots = robots;
    else if (type === 'switchedRobot') {
      if (this.robots === null) throw new TypeError('switchedRobot without a list');
      this.selected = this.robots.find(({ id }) => id === robotId) ?? null;
      if (this.selected === null) this.errors.push(`robot ${robotId} not found`);
    }
  }
}
