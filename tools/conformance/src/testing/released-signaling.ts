/**
 * Stand-in for the reference system's released signaling server, with its actual behaviour, including defects:
 *
 * - two plain WebSocket servers, any path, ids from 0;
 * - `0` counts as no id in a robot's `offer`, `candidate` and `deregister`: they are dropped;
 * - any robot's socket may act for any robot but 0;
 * - one client: messages are pushed to the socket that connected last; `getRobots` is answered to whoever asks;
 * - an explicit `deregister` is pushed as `deregister` without an id; the robot is then forgotten, and the end of its
 *   socket is reported to nobody;
 * - a socket that ends removes the registration with the smallest id: a robot that registered twice leaves the other
 *   one listed;
 * - an answer is passed on whatever became of the offer, and is kept in the list beside the next one;
 * - text that is not JSON, or `null`, ends the program.
 */
import type { WebSocket, WebSocketServer } from 'ws';
import { closePlainServer, openPlainServer, plainServerUrl } from './plain-socket-server.ts';

interface Registration {
  id: number;
  name: unknown;
  sdpOffer: unknown;
  sdpAnswer: unknown;
  robotCandidates: unknown[];
  clientCandidates: unknown[];
}

type Message = Record<string, unknown>;

export class ReleasedSignaling {
  /** Why the program ended; `null` while it runs. */
  death: string | null = null;
  readonly robotUrl: string;
  readonly clientUrl: string;
  readonly #robotPort: WebSocketServer;
  readonly #clientPort: WebSocketServer;
  readonly #robots: Registration[] = [];
  readonly #sockets = new Map<number, WebSocket>();
  #nextId = 0;
  #client: WebSocket | null = null;

  private constructor(robotPort: WebSocketServer, clientPort: WebSocketServer) {
    this.#robotPort = robotPort;
    this.#clientPort = clientPort;
    this.robotUrl = plainServerUrl(robotPort);
    this.clientUrl = plainServerUrl(clientPort);
    robotPort.on('connection', (socket) => {
      socket.on('message', (data) => this.#run(() => this.#onRobot(socket, parse(data))));
      socket.on('close', () => this.#onRobotGone(socket));
      socket.on('error', () => undefined);
    });
    clientPort.on('connection', (socket) => {
      this.#client = socket;
      socket.on('message', (data) => this.#run(() => this.#onClient(socket, parse(data))));
      socket.on('error', () => undefined);
    });
  }

  /** Starts it on free ports of this machine. */
  static async start(): Promise<ReleasedSignaling> {
    const [robotPort, clientPort] = await Promise.all([openPlainServer(), openPlainServer()]);
    return new ReleasedSignaling(robotPort, clientPort);
  }

  /** Ids in the order of the list. */
  get listed(): readonly number[] {
    return this.#robots.map(({ id }) => id);
  }

  async stop(): Promise<void> {
    await Promise.all([closePlainServer(this.#robotPort), closePlainServer(this.#clientPort)]);
  }

  #run(handle: () => void): void {
    try {
      handle();
    } catch (error) {
      this.death = String(error);
      void this.stop();
    }
  }

  #onRobot(socket: WebSocket, { type, name, robotId, sdpOffer, candidate }: Message): void {
    const robot = robotId ? this.#robots.find(({ id }) => id === robotId) : undefined;
    if (type === 'register') {
      const made: Registration = {
        id: this.#nextId++,
        name,
        sdpOffer: sdpOffer || null,
        sdpAnswer: null,
        robotCandidates: [],
        clientCandidates: [],
      };
      this.#sockets.set(made.id, socket);
      this.#robots.push(made);
      send(socket, { type: 'registered', robotId: made.id });
      this.#push({ type: 'register', robot: made });
    } else if (type === 'offer' && robot !== undefined && sdpOffer) {
      robot.sdpOffer = sdpOffer;
      this.#push({ type, robotId, sdpOffer });
    } else if (type === 'candidate' && robot !== undefined && candidate) {
      robot.robotCandidates.push(candidate);
      this.#push({ type, robotId, candidate });
    } else if (type === 'deregister' && robot !== undefined) {
      this.#forget(robot);
      this.#push({ type });
    }
  }

  #onRobotGone(socket: WebSocket): void {
    const robot = this.#robots.find(({ id }) => this.#sockets.get(id) === socket);
    if (robot === undefined) return;
    this.#forget(robot);
    this.#push({ type: 'deregistered', robotId: robot.id });
  }

  #onClient(socket: WebSocket, { type, robotId, sdpAnswer, candidate }: Message): void {
    if (type === 'getRobots') {
      send(socket, { type: 'robots', robots: this.#robots });
      return;
    }
    const robot = this.#robots.find(({ id }) => id === robotId);
    const robotSocket = this.#sockets.get(robotId as number);
    if (robot === undefined || robotSocket === undefined) return;
    if (type === 'answer') {
      robot.sdpAnswer = sdpAnswer;
      send(robotSocket, { type: 'sdpAnswer', sdpAnswer });
    } else if (type === 'candidate') {
      robot.clientCandidates.push(candidate);
      send(robotSocket, { type, candidate });
    }
  }

  #forget(robot: Registration): void {
    this.#robots.splice(this.#robots.indexOf(robot), 1);
    this.#sockets.delete(robot.id);
  }

  #push(message: object): void {
    if (this.#client !== null) send(this.#client, message);
  }
}

/** @throws {Error} for a message that ends the program */
function parse(data: unknown): Message {
  const message = JSON.parse(String(data)) as Message | null;
  if (message === null) throw new TypeError('a message that is null');
  return message;
}

function send(socket: WebSocket, message: object): void {
  if (socket.readyState === socket.OPEN) socket.send(JSON.stringify(message));
}
