/** The open calls of one service: when each may be sent, whose reply it is, and when none can come any more. Pure. */
import { RosFault } from '@farpoint/ros';
import { readRequestHeader, withoutRequestHeader, withRequestHeader } from './request-header.ts';
import { type MatchedEndpoint, type ServiceServers, serversOf } from './service-servers.ts';

/** Calls that wait for their replies. Chosen: twice the commands that a robot has, which may all be cancelled at once; service-calls.test.ts holds it. */
const MOST_OPEN = 64;
/** Of a reply, bytes; the rest is cut. Chosen: a status and a sentence; service-calls.test.ts holds it. */
const MOST_REPLY_BYTES = 64 * 1024;

/** The service’s two topics, as DDS has them. */
export interface ServiceEndpoints {
  readonly readers: readonly MatchedEndpoint[];
  readonly writers: readonly MatchedEndpoint[];
  /** The types under which others serve it, if they are not ours. */
  readonly otherTypes: readonly string[];
  /** @returns whether DDS took it */
  write(bytes: Uint8Array): boolean;
}

interface OpenCall {
  readonly request: Uint8Array;
  readonly withinMs: number;
  readonly deadlineMs: number;
  /** Who heard it; `null`: it waits until somebody does who can also reply. */
  heardBy: ReadonlySet<string> | null;
  readonly resolve: (reply: Uint8Array) => void;
  readonly reject: (fault: RosFault) => void;
}

export class ServiceCalls {
  readonly #service: string;
  readonly #client: bigint;
  readonly #endpoints: ServiceEndpoints;
  readonly #now: () => number;
  readonly #open = new Map<bigint, OpenCall>();
  #sequence = 0n;
  #isClosed = false;

  /** @param client 64 bits that no other client has @param now ms */
  constructor(service: string, client: bigint, endpoints: ServiceEndpoints, now: () => number) {
    this.#service = service;
    this.#client = client;
    this.#endpoints = endpoints;
    this.#now = now;
  }

  /** How many calls wait for their replies. */
  get open(): number {
    return this.#open.size;
  }

  /** Whether a call would be sent at once. */
  get isReady(): boolean {
    const { whole, foreign } = serversOf(this.#endpoints.readers, this.#endpoints.writers);
    return !this.#isClosed && foreign === null && whole.size > 0;
  }

  /** See `ServiceClient.call`. */
  call(request: Uint8Array, withinMs: number): Promise<Uint8Array> {
    return new Promise((resolve, reject) => {
      if (this.#isClosed) reject(this.#fault('lost', 'the graph is closed'));
      else if (this.#open.size >= MOST_OPEN)
        reject(this.#fault('refused', `${MOST_OPEN} calls wait for an answer`));
      else {
        const deadlineMs = this.#now() + withinMs;
        const call = { request: request.slice(), withinMs, deadlineMs, heardBy: null, resolve, reject };
        this.#open.set(++this.#sequence, call);
        this.update();
      }
    });
  }

  /** Takes what came on the topic of replies: those for others, and what is none, are dropped. */
  take(bytes: Uint8Array): void {
    const header = readRequestHeader(bytes);
    if (header === null || header.client !== this.#client) return;
    const call = this.#open.get(header.sequence);
    if (call === undefined || call.heardBy === null) return;
    this.#open.delete(header.sequence);
    call.resolve(withoutRequestHeader(bytes, MOST_REPLY_BYTES));
  }

  /** Sends what can be sent, and ends what cannot end otherwise. Call this whenever discovery has news, and while calls are open. */
  update(): void {
    if (this.#open.size === 0) return;
    const servers = serversOf(this.#endpoints.readers, this.#endpoints.writers);
    for (const [sequence, call] of this.#open) {
      const fault = this.#advance(sequence, call, servers);
      if (fault === null) continue;
      this.#open.delete(sequence);
      call.reject(fault);
    }
  }

  close(): void {
    this.#isClosed = true;
    const calls = [...this.#open.values()];
    this.#open.clear();
    for (const { reject } of calls) reject(this.#fault('lost', 'the graph is closed'));
  }

  /** @returns why no reply can come */
  #advance(sequence: bigint, call: OpenCall, servers: ServiceServers): RosFault | null {
    if (this.#now() >= call.deadlineMs)
      return this.#fault('lost', `no answer within ${call.withinMs / 1000} s`);
    if (call.heardBy !== null) {
      const isThere = [...call.heardBy].some((id) => servers.replying.has(id));
      return isThere ? null : this.#fault('lost', 'its server has gone while it was called');
    }
    const absence = this.#absence(servers);
    if (absence !== null || servers.whole.size === 0) return absence;
    call.heardBy = servers.whole;
    const header = { client: this.#client, sequence };
    if (this.#endpoints.write(withRequestHeader(header, call.request))) return null;
    return this.#fault('refused', 'its server is too slow for another request');
  }

  /** @returns why nothing may be sent; `null` if a server is there, or is being discovered */
  #absence({ isHeard, foreign }: ServiceServers): RosFault | null {
    // DDS would send the request to all that hear it.
    if (foreign !== null)
      return this.#fault('unsupported', `its server runs on ${foreign} without rmw_cyclonedds`, {
        remedy: 'start the server with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp',
      });
    if (isHeard) return null;
    const [type] = this.#endpoints.otherTypes;
    return type === undefined
      ? this.#fault('unavailable', 'there is no such service')
      : this.#fault('wrong-type', `its server takes ${type}`);
  }

  #fault(
    code: 'lost' | 'refused' | 'unavailable' | 'unsupported' | 'wrong-type',
    what: string,
    about = {},
  ): RosFault {
    return new RosFault(code, what, { topic: this.#service, ...about });
  }
}
