/** Janus, as far as the watchers' page speaks with it before there are media: a script says how it answers. */
import type { Broadcast } from '@farpoint/protocol';
import type { Page, WebSocketRoute } from '@playwright/test';

export const JANUS_URL = 'wss://janus.example/';

/** What Janus does with those who ask for the robot's broadcast. */
export type JanusAnswer =
  /** There is no such mountpoint. */
  | 'no-mountpoint'
  /** Their PIN is wrong. */
  | 'wrong-pin'
  /** The mountpoint is somebody else's. */
  | 'not-a-robot'
  /** It lets them in, and sends no media. */
  | Broadcast
  /** Nobody is there to answer. */
  | 'away';

interface Request {
  janus: string;
  transaction: string;
  body?: { request: string; id?: number; pin?: string };
}

/** Numbers of the streaming plugin's errors. */
const [NO_MOUNTPOINT, UNAUTHORISED] = [455, 457];

export class ScriptedJanus {
  answer: JanusAnswer = 'away';
  /** Requests to watch. */
  readonly watched: unknown[] = [];
  #socket: WebSocketRoute | null = null;

  static async open(page: Page): Promise<ScriptedJanus> {
    const janus = new ScriptedJanus();
    await page.routeWebSocket(JANUS_URL, (socket) => janus.#take(socket));
    return janus;
  }

  /** Its connection to the page ends. */
  async stop(): Promise<void> {
    this.answer = 'away';
    await this.#socket?.close();
  }

  #take(socket: WebSocketRoute): void {
    this.#socket = socket;
    if (this.answer === 'away') void socket.close();
    else socket.onMessage((text) => this.#reply(socket, JSON.parse(String(text)) as Request));
  }

  #reply(socket: WebSocketRoute, { janus, transaction, body }: Request): void {
    const say = (message: object) => socket.send(JSON.stringify(message));
    const done = (data: object) => say({ janus: 'success', transaction, ...data });
    if (janus === 'create' || janus === 'attach') done({ data: { id: 1 } });
    else if (body?.request === 'info') done({ plugindata: { data: this.#info() } });
    else say({ janus: 'ack', transaction });
    if (body?.request !== 'watch') return;
    this.watched.push(body);
    if (this.answer !== 'wrong-pin') return;
    const data = { streaming: 'event', error_code: UNAUTHORISED, error: 'wrong PIN' };
    say({ janus: 'event', sender: 1, plugindata: { data } });
  }

  #info(): object {
    const { answer } = this;
    if (answer === 'no-mountpoint') return { error_code: NO_MOUNTPOINT, error: 'No such mountpoint' };
    const metadata =
      answer === 'not-a-robot'
        ? 'Radio'
        : JSON.stringify(typeof answer === 'object' ? answer : broadcastOf('Rover', []));
    return { streaming: 'info', info: { id: 3, metadata, media: [] } };
  }
}

/** @param cameras their names */
export function broadcastOf(name: string, cameras: readonly string[]): Broadcast {
  const videos = cameras.map((camera, i) => ({ name: camera, mid: `v${i}`, codec: 'VP8' as const }));
  return { type: 'farpointBroadcast', version: 1, name, videos };
}
