/**
 * The clients of `pnpm bench signaling`, in their own process: many robots and operators on real sockets. It is
 * started with its plan as JSON in argv, and prints its result as one line of JSON. Both ends of every relay are in
 * this process, so that a single clock times it: from handing a message to the sender's socket until the receiver's
 * socket emits it.
 */
import { monitorEventLoopDelay } from 'node:perf_hooks';
import { WebSocket } from 'ws';

export interface ClientPlan {
  url: string;
  robots: number;
  operators: number;
  /** Sessions begun per second. */
  rate: number;
  /** Candidates in each direction per session. */
  candidates: number;
  /**
   * Robots per second that disconnect and reconnect while sessions are set up. They are not among the robots in
   * sessions.
   */
  churn: number;
}

export interface ClientResult {
  connectMs: number[];
  /** From session.open to session.opened. */
  openMs: number[];
  relayMs: Record<'session.offer' | 'session.answer' | 'session.candidate', number[]>;
  /** How late this process's own timers were while sessions were set up, p99. All times above include this. */
  lateMsP99: number;
  lists: number;
  listMegabytes: number;
  /** Descriptions of errors, with counts. */
  errors: Record<string, number>;
}

/** Messages to the parent between the phases. */
export type PhaseMessage = 'connected' | 'done';

const CONNECTING_AT_ONCE = 64;
const PHASE_TIMEOUT_MS = 120_000;
const LIST = Buffer.from('{"type":"robots');
// As long as those of werift and Chromium.
const SDP = `v=0\r\n${'a=rtcp-fb:96 transport-cc\r\n'.repeat(100)}`;
const CANDIDATE =
  'candidate:1 1 udp 2122260223 192.168.178.21 54321 typ host generation 0 ufrag abcd network-id 1 ';

interface Message {
  type: string;
  session?: string;
  sdp?: string;
  candidate?: { candidate: string };
  code?: string;
}

const result: ClientResult = {
  connectMs: [],
  openMs: [],
  relayMs: { 'session.offer': [], 'session.answer': [], 'session.candidate': [] },
  lateMsP99: 0,
  lists: 0,
  listMegabytes: 0,
  errors: {},
};
/** Sockets that this process closes itself. */
const leaving = new WeakSet<WebSocket>();
let closing = false;

function fault(what: string): void {
  result.errors[what] = (result.errors[what] ?? 0) + 1;
}

/** Opens a socket and waits for its welcome. */
function connect(
  url: string,
  path: string,
  hello: object,
  onMessage: (message: Message, now: number) => void,
): Promise<WebSocket> {
  const begin = performance.now();
  const socket = new WebSocket(url + path, { perMessageDeflate: false, handshakeTimeout: 30_000 });
  return new Promise((resolve, reject) => {
    socket.once('open', () => socket.send(JSON.stringify(hello)));
    socket.on('error', (error) => {
      fault(error.message);
      reject(error);
    });
    socket.on('close', (code) => {
      if (!closing && !leaving.has(socket)) fault(`closed ${code}`);
    });
    socket.on('message', (data: Buffer) => {
      const now = performance.now();
      // Thousands of lists and changes arrive. A page reads each; this process only needs to know that they came.
      if (data.subarray(0, LIST.length).equals(LIST)) {
        result.lists++;
        result.listMegabytes += data.length / 1e6;
        return;
      }
      const message = JSON.parse(data.toString()) as Message;
      if (message.type.endsWith('.welcome')) {
        result.connectMs.push(now - begin);
        resolve(socket);
      } else if (message.type === 'error') fault(`error ${message.code}`);
      else onMessage(message, now);
    });
  });
}

/** The send time that a text contains. */
function sentAt(text: string | undefined): number {
  return Number(text?.slice(text.lastIndexOf(' ') + 1));
}

/** Counts the relays of all sessions. */
class Relays {
  /** Resolves when all have come, or after {@link giveUp}. */
  readonly ended: Promise<void>;
  giveUp = (): void => {};
  readonly #expected: number;
  #received = 0;

  constructor({ operators, candidates }: ClientPlan) {
    this.#expected = operators * (2 + 2 * candidates);
    this.ended = new Promise((resolve) => {
      this.giveUp = resolve;
    });
  }

  get complete(): boolean {
    return this.#received === this.#expected;
  }

  /** @param text contains the time at which it was sent */
  note(type: keyof ClientResult['relayMs'], text: string | undefined, now: number): void {
    result.relayMs[type].push(now - sentAt(text));
    this.#received++;
    if (this.complete) this.giveUp();
  }
}

/** All robots and operators, who answer each other. */
class Peers {
  readonly #plan: ClientPlan;
  readonly #relays: Relays;
  readonly #robots: WebSocket[] = [];
  readonly #operators: WebSocket[] = [];
  readonly #openedAt: number[] = [];

  constructor(plan: ClientPlan, relays: Relays) {
    this.#plan = plan;
    this.#relays = relays;
  }

  async connectRobot(index: number): Promise<void> {
    const hello = {
      type: 'robot.hello',
      protocol: 1,
      id: `robot-${index}`,
      name: `Robot ${index}`,
      key: `k${index}`,
    };
    const { url } = this.#plan;
    this.#robots[index] = await connect(url, '/robot', hello, ({ type, session, sdp, candidate }, now) => {
      if (type === 'session.request') this.#describe(this.#robots[index]!, 'session.offer', session);
      else if (type === 'session.answer') this.#relays.note(type, sdp, now);
      else if (type === 'session.candidate') this.#relays.note(type, candidate?.candidate, now);
      else if (!closing) fault(type);
    });
  }

  async connectOperator(index: number): Promise<void> {
    const hello = { type: 'operator.hello', protocol: 1, name: `Operator ${index}` };
    const { url } = this.#plan;
    this.#operators[index] = await connect(
      url,
      '/operator',
      hello,
      ({ type, session, sdp, candidate }, now) => {
        if (type === 'session.opened') result.openMs.push(now - this.#openedAt[index]!);
        else if (type === 'session.offer') {
          this.#relays.note(type, sdp, now);
          this.#describe(this.#operators[index]!, 'session.answer', session);
        } else if (type === 'session.candidate') this.#relays.note(type, candidate?.candidate, now);
        else if (!closing) fault(type);
      },
    );
  }

  /** Opens a session of an operator. */
  open(index: number): void {
    this.#openedAt[index] = performance.now();
    const robotId = `robot-${index % this.#plan.robots}`;
    this.#operators[index]!.send(JSON.stringify({ type: 'session.open', robotId }));
  }

  closeRobot(index: number): void {
    leaving.add(this.#robots[index]!);
    this.#robots[index]!.close();
  }

  terminate(): void {
    for (const socket of [...this.#robots, ...this.#operators]) socket?.terminate();
  }

  /** Sends a description, and then the candidates. */
  #describe(socket: WebSocket, type: string, session: string | undefined): void {
    socket.send(JSON.stringify({ type, session, sdp: `${SDP}a=x-sent: ${performance.now()}` }));
    for (let i = 0; i < this.#plan.candidates; i++) {
      const candidate = { candidate: CANDIDATE + performance.now(), sdpMid: '0', sdpMLineIndex: 0 };
      socket.send(JSON.stringify({ type: 'session.candidate', session, candidate }));
    }
  }
}

async function run(plan: ClientPlan): Promise<void> {
  const relays = new Relays(plan);
  const peers = new Peers(plan, relays);
  await inParallel(plan.robots, (index) => peers.connectRobot(index));
  await inParallel(plan.operators, (index) => peers.connectOperator(index));
  await tellParent('connected');

  const timer = setTimeout(() => {
    fault('not everything was relayed in time');
    relays.giveUp();
  }, PHASE_TIMEOUT_MS);
  const churn = startChurn(peers, plan);
  const delay = monitorEventLoopDelay({ resolution: 1 });
  delay.enable();
  await openSessions(peers, plan);
  await relays.ended;
  clearTimeout(timer);
  delay.disable();
  result.lateMsP99 = delay.percentile(99) / 1e6;
  if (churn !== null) clearInterval(churn);
  if (!relays.complete) fault('relays missing');
  await tellParent('done');
  closing = true;
  peers.terminate();
}

/** Lets robots that are in no session come and go until the timer is cleared. */
function startChurn(peers: Peers, { robots, churn }: ClientPlan): NodeJS.Timeout | null {
  if (churn === 0) return null;
  let churned = 0;
  return setInterval(() => {
    const index = robots + (churned++ % 8);
    void peers
      .connectRobot(index)
      .then(() => peers.closeRobot(index))
      .catch(() => {});
  }, 1000 / churn);
}

async function openSessions(peers: Peers, { operators, rate }: ClientPlan): Promise<void> {
  const begin = performance.now();
  for (let index = 0; index < operators; index++) {
    const wait = begin + (index * 1000) / rate - performance.now();
    if (wait > 1) await new Promise((resolve) => setTimeout(resolve, wait));
    peers.open(index);
  }
}

/** Runs `count` tasks, at most {@link CONNECTING_AT_ONCE} at a time. */
async function inParallel(count: number, task: (index: number) => Promise<void>): Promise<void> {
  let next = 0;
  await Promise.all(
    Array.from({ length: Math.min(count, CONNECTING_AT_ONCE) }, async () => {
      while (next < count) await task(next++);
    }),
  );
}

/** Tells the parent that a phase is over, and waits until it has taken its measurements. */
function tellParent(phase: PhaseMessage): Promise<void> {
  return new Promise((resolve) => {
    process.once('message', () => resolve());
    process.send!(phase);
  });
}

await run(JSON.parse(process.argv[2] ?? '') as ClientPlan);
process.send!(result, () => process.disconnect());
