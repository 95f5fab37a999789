/** A ROS 2 graph through rclnodejs and the sourced ROS installation, with any middleware. */
import { type ChildProcess, fork } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { RosFault } from '../fault.ts';
import {
  type AdvertiseAs,
  type GraphTopic,
  type OnMessage,
  type Publisher,
  RELIABLE_QOS,
  type RosGraph,
  SENSOR_QOS,
  type SubscribeTo,
  type Subscription,
} from '../graph.ts';
import { type Environment, type RclOptions, rclEnvironment } from './environment.ts';
import type { EndpointCounts, ProcessReport, ProcessRequest } from './process-messages.ts';

const PROGRAM = fileURLToPath(new URL('./rcl-process.ts', import.meta.url));
/** rclnodejs may have to generate messages at its first start. */
const START_MS = 60_000;
const AGAIN_MS = 1000;
/** In addition to the wait for the last acknowledgement. */
const END_MS = 2000;
/** A process with this many unread requests hangs, and is killed. */
const MOST_UNSENT = 64;

export interface RclnodejsGraphOptions extends RclOptions {
  /** The node's name. */
  name: string;
  /** From `findRclnodejs`. */
  entry: string;
  /** The clock of `receivedMs`, ms. */
  now: () => number;
  env?: Environment;
}

interface Member extends EndpointCounts {
  /** Counts of earlier processes. */
  before: { received: number; dropped: number };
  request: ProcessRequest & { is: 'subscribe' | 'advertise' };
  onMessage: OnMessage | null;
}

export class RclnodejsGraph implements RosGraph {
  readonly version = 2;
  onFault: ((fault: RosFault) => void) | null = null;
  readonly #options: RclnodejsGraphOptions;
  readonly #members = new Map<number, Member>();
  #process: ChildProcess | null = null;
  #again: NodeJS.Timeout | null = null;
  #topics: readonly GraphTopic[] = [];
  #nextId = 1;
  #unsent = 0;
  #closed = false;

  private constructor(options: RclnodejsGraphOptions) {
    this.#options = options;
  }

  /** @throws {RosFault} `unavailable`: it does not start, with the reason */
  static async open(options: RclnodejsGraphOptions): Promise<RclnodejsGraph> {
    const graph = new RclnodejsGraph(options);
    try {
      await graph.#start();
    } catch (error) {
      await graph.close();
      throw error;
    }
    return graph;
  }

  subscribe(to: SubscribeTo, onMessage: OnMessage): Subscription {
    const { topic, type, qos = SENSOR_QOS, queue } = to;
    const member = this.#add(
      (id) => ({ is: 'subscribe', endpoint: { id, topic, type, qos }, queue }),
      onMessage,
    );
    return {
      topic,
      definition: null,
      get received() {
        return member.before.received + member.received;
      },
      get dropped() {
        return member.before.dropped + member.dropped;
      },
      get publishers() {
        return member.others;
      },
      close: () => this.#remove(member),
    };
  }

  advertise({ topic, type, qos = RELIABLE_QOS }: AdvertiseAs): Publisher {
    const member = this.#add((id) => ({ is: 'advertise', endpoint: { id, topic, type, qos } }), null);
    return {
      topic,
      get subscribers() {
        return member.others;
      },
      publish: (bytes) => {
        if (this.#members.has(member.id)) this.#send({ is: 'publish', id: member.id, bytes });
      },
      close: () => this.#remove(member),
    };
  }

  topics(): readonly GraphTopic[] {
    return this.#topics;
  }

  async close(): Promise<void> {
    this.#closed = true;
    if (this.#again !== null) clearTimeout(this.#again);
    this.#members.clear();
    this.#topics = [];
    const child = this.#process;
    if (child === null) return;
    const ended = new Promise((resolve) => child.once('exit', resolve));
    this.#send({ is: 'close' });
    const timer = setTimeout(() => child.kill('SIGKILL'), END_MS);
    await ended;
    clearTimeout(timer);
  }

  #add(requestOf: (id: number) => Member['request'], onMessage: OnMessage | null): Member {
    const id = this.#nextId++;
    const none = { received: 0, dropped: 0 };
    const member: Member = { id, request: requestOf(id), onMessage, before: none, ...none, others: 0 };
    this.#members.set(id, member);
    this.#send(member.request);
    return member;
  }

  #remove(member: Member): void {
    member.others = 0;
    if (this.#members.delete(member.id)) this.#send({ is: 'remove', id: member.id });
  }

  #send(request: ProcessRequest): void {
    // Nothing is sent to a process that has ended; a restarted one is sent everything.
    const child = this.#process;
    if (!child?.connected) return;
    this.#unsent++;
    child.send(request, () => {
      if (child === this.#process) this.#unsent--;
    });
    if (this.#unsent > MOST_UNSENT) child.kill('SIGKILL');
  }

  /** Resolves once it is ready. */
  #start(): Promise<void> {
    const { name, entry, env = process.env } = this.#options;
    const child = fork(PROGRAM, [JSON.stringify({ name, entry })], {
      serialization: 'advanced',
      execArgv: [],
      env: rclEnvironment(this.#options, env),
      // Its standard output joins standard error, which our own output does not use.
      stdio: ['ignore', 2, 2, 'ipc'],
    });
    this.#process = child;
    this.#unsent = 0;
    return new Promise((resolve, reject) => {
      let ready = false;
      const refuse = (what: string, remedy?: string) =>
        reject(new RosFault('unavailable', what, remedy === undefined ? {} : { remedy }));
      const timer = setTimeout(() => child.kill('SIGKILL'), START_MS);
      child.on('message', (report: ProcessReport) => {
        if (report.is === 'ready') {
          ready = true;
          clearTimeout(timer);
          resolve();
        } else if (report.is === 'failed') refuse(report.what, report.remedy);
        else this.#take(report);
      });
      child.once('error', ({ message }) => refuse(message));
      child.once('exit', (code, signal) => {
        clearTimeout(timer);
        this.#process = null;
        const how = `rclnodejs’s process ended (${signal ?? code})`;
        if (ready) this.#ended(how);
        else refuse(how);
      });
    });
  }

  #ended(how: string): void {
    if (this.#closed) return;
    this.#topics = [];
    for (const member of this.#members.values()) {
      const { before, received, dropped } = member;
      member.before = { received: before.received + received, dropped: before.dropped + dropped };
      Object.assign(member, { received: 0, dropped: 0, others: 0 });
    }
    this.onFault?.(new RosFault('lost', `${how}; it will be restarted`));
    this.#startAgain();
  }

  #startAgain(): void {
    this.#again = setTimeout(() => {
      this.#start().then(
        () => {
          for (const { request } of this.#members.values()) this.#send(request);
        },
        (error: RosFault) => {
          if (this.#closed) return;
          this.onFault?.(error);
          this.#startAgain();
        },
      );
    }, AGAIN_MS);
  }

  #take(report: ProcessReport): void {
    switch (report.is) {
      case 'message': {
        const { id, bytes, receivedMs } = report;
        const ageMs = Number(process.hrtime.bigint()) / 1e6 - receivedMs;
        try {
          this.#members.get(id)?.onMessage?.(bytes, this.#options.now() - Math.max(0, ageMs));
        } finally {
          this.#send({ is: 'taken', id });
        }
        break;
      }
      case 'counts':
        for (const { id, ...counts } of report.counts) Object.assign(this.#members.get(id) ?? {}, counts);
        break;
      case 'topics':
        this.#topics = report.topics;
        break;
      case 'fault':
        this.onFault?.(new RosFault(report.code, report.what, { topic: report.topic }));
        break;
    }
  }
}
