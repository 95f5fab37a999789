/** One WebSocket to Janus, with one session and one handle of the streaming plugin. */
import * as z from 'zod/mini';
import { JanusFailure, pluginFailure } from './janus-failure.ts';
import { type JanusCandidate, type JanusMessage, type Jsep, readJanusMessage } from './janus-message.ts';
import {
  type CreatedMountpoint,
  createBody,
  createdSchema,
  doneSchema,
  failureSchema,
  infoSchema,
  type MountpointInfo,
  type MountpointRequest,
  type StreamingEvent,
  streamingEventSchema,
} from './streaming-message.ts';

/** What the client needs of a WebSocket. */
export interface JanusSocket {
  send(text: string): void;
  close(): void;
  onopen: ((event: never) => void) | null;
  onmessage: ((event: never) => void) | null;
  onclose: ((event: never) => void) | null;
  onerror: ((event: never) => void) | null;
}

export interface StreamingClientOptions {
  /** Opens a WebSocket with the subprotocol `janus-protocol`. */
  open: () => JanusSocket;
  /** How long Janus may take for an answer, ms. */
  timeoutMs?: number | undefined;
}

export interface StreamingClientEvents {
  onEvent?(event: StreamingEvent, jsep: Jsep | undefined): void;
  onCandidate?(candidate: JanusCandidate): void;
  /** The peer connection is over. */
  onHangup?(reason: string): void;
  /** The WebSocket or the session is over; nothing follows. Not called after `close`. */
  onClosed(failure: JanusFailure): void;
}

/** Janus has this long to answer, ms. Chosen: below the 5 s of {@link KEEP_ALIVE_MS}, so that a request fails before the next beat. */
const TIMEOUT_MS = 4000;
/** Janus ends sessions that say nothing; and a dead connection is noticed by this, ms. */
const KEEP_ALIVE_MS = 5000;

interface Waiting {
  resolve(message: JanusMessage): void;
  reject(failure: JanusFailure): void;
  timer: ReturnType<typeof setTimeout>;
}

export class StreamingClient {
  readonly #socket: JanusSocket;
  readonly #timeoutMs: number;
  readonly #events: StreamingClientEvents;
  readonly #waiting = new Map<string, Waiting>();
  #transaction = 0;
  #session: number | null = null;
  #handle: number | null = null;
  #keepAlive: ReturnType<typeof setInterval> | undefined;
  #ended = false;
  /** Messages that are none of Janus', so far. */
  malformed = 0;

  private constructor(
    { open, timeoutMs = TIMEOUT_MS }: StreamingClientOptions,
    events: StreamingClientEvents,
  ) {
    this.#socket = open();
    this.#timeoutMs = timeoutMs;
    this.#events = events;
  }

  /** Connects, and attaches to the streaming plugin. @throws {JanusFailure} */
  static async connect(
    options: StreamingClientOptions,
    events: StreamingClientEvents,
  ): Promise<StreamingClient> {
    let client: StreamingClient;
    try {
      client = new StreamingClient(options, events);
    } catch (error) {
      // A WebSocket refuses an address that is none.
      throw new JanusFailure('unreachable', String(error));
    }
    try {
      await client.#connect();
    } catch (error) {
      client.close();
      throw error;
    }
    return client;
  }

  /** @throws {JanusFailure} */
  async create(request: MountpointRequest): Promise<CreatedMountpoint> {
    return (await this.#ask(createBody(request), createdSchema)).stream;
  }

  /** @param secret the mountpoint's; without it, only what everybody may know. @throws {JanusFailure} */
  async info(id: number, secret?: string): Promise<MountpointInfo> {
    const body = { request: 'info', id, ...(secret === undefined ? {} : { secret }) };
    return (await this.#ask(body, infoSchema)).info;
  }

  /** Replaces the metadata, and tells those who watch. @throws {JanusFailure} */
  async edit(id: number, secret: string, metadata: string): Promise<void> {
    const body = { request: 'edit', id, secret, new_metadata: metadata, edited_event: true };
    await this.#ask(body, doneSchema);
  }

  /** @throws {JanusFailure} */
  async destroy(id: number, secret: string): Promise<void> {
    await this.#ask({ request: 'destroy', id, secret }, doneSchema);
  }

  /** Asks for an offer, which comes as an event, as does a refusal. @throws {JanusFailure} */
  async watch(id: number, pin: string | null): Promise<void> {
    await this.#message({ request: 'watch', id, ...(pin === null ? {} : { pin }) });
  }

  /** Answers the offer. @throws {JanusFailure} */
  async start(answer: Jsep): Promise<void> {
    await this.#message({ request: 'start' }, answer);
  }

  /** Tells a candidate of ours; `null`: there are no more. */
  trickle(
    candidate: { candidate: string; sdpMid: string | null; sdpMLineIndex: number | null } | null,
  ): void {
    if (this.#ended) return;
    const message = { janus: 'trickle', candidate: candidate ?? { completed: true } };
    this.#request(message).catch(() => undefined);
  }

  close(): void {
    if (this.#ended) return;
    if (this.#session !== null) this.#send({ janus: 'destroy' });
    this.#end(new JanusFailure('closed', 'closed by us'));
  }

  async #connect(): Promise<void> {
    const socket = this.#socket;
    socket.onmessage = ({ data }: { data: unknown }) => this.#onMessage(data);
    const opened = new Promise<void>((resolve, reject) => {
      const fail = (failure: JanusFailure): void => {
        reject(failure);
        this.#fail(failure);
      };
      const timer = setTimeout(
        () => fail(new JanusFailure('timeout', 'no connection in time')),
        this.#timeoutMs,
      );
      socket.onopen = () => {
        clearTimeout(timer);
        resolve();
      };
      // An error is followed by a close, but some failures show as one of the two only.
      const onEnd = (): void => {
        clearTimeout(timer);
        if (this.#session === null) fail(new JanusFailure('unreachable', 'Janus cannot be reached'));
        else fail(new JanusFailure('closed', 'the connection to Janus was closed'));
      };
      socket.onclose = onEnd;
      socket.onerror = onEnd;
    });
    await opened;
    this.#session = idOf(await this.#request({ janus: 'create' }));
    this.#handle = idOf(await this.#request({ janus: 'attach', plugin: 'janus.plugin.streaming' }));
    this.#keepAlive = setInterval(() => {
      this.#request({ janus: 'keepalive' }, false).catch((failure: unknown) => {
        if (failure instanceof JanusFailure) this.#fail(failure);
      });
    }, KEEP_ALIVE_MS);
  }

  /** A request that the plugin answers at once. */
  async #ask<T>(body: object, schema: z.ZodMiniType<T>): Promise<T> {
    const message = await this.#request({ janus: 'message', body });
    const data = message.janus === 'success' ? message.plugindata?.data : undefined;
    const refused = z.safeParse(failureSchema, data);
    if (refused.success) throw pluginFailure(refused.data.error_code, refused.data.error);
    const parsed = z.safeParse(schema, data);
    if (!parsed.success) throw new JanusFailure('malformed', 'Janus gave an answer that cannot be read');
    return parsed.data;
  }

  /** A request whose answer is an event. */
  async #message(body: object, jsep?: Jsep): Promise<void> {
    await this.#request({ janus: 'message', body, ...(jsep === undefined ? {} : { jsep }) });
  }

  #request(message: object, withHandle = true): Promise<JanusMessage> {
    if (this.#ended) return Promise.reject(new JanusFailure('closed', 'the connection to Janus is closed'));
    const transaction = this.#send(message, withHandle);
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        this.#waiting.delete(transaction);
        reject(new JanusFailure('timeout', 'Janus does not answer'));
      }, this.#timeoutMs);
      this.#waiting.set(transaction, { resolve, reject, timer });
    });
  }

  #send(message: object, withHandle = true): string {
    const transaction = String(++this.#transaction);
    const session = this.#session === null ? {} : { session_id: this.#session };
    const handle = this.#handle === null || !withHandle ? {} : { handle_id: this.#handle };
    this.#socket.send(JSON.stringify({ ...message, ...session, ...handle, transaction }));
    return transaction;
  }

  #onMessage(data: unknown): void {
    if (this.#ended) return;
    const message = readJanusMessage(data);
    if (message === null) {
      this.malformed++;
      return;
    }
    switch (message.janus) {
      case 'success':
      case 'ack':
        this.#take(message.transaction)?.resolve(message);
        return;
      case 'error': {
        const { code, reason } = message.error;
        this.#take(message.transaction)?.reject(new JanusFailure('refused', reason, code));
        return;
      }
      case 'event': {
        const parsed = z.safeParse(streamingEventSchema, message.plugindata.data);
        if (parsed.success) this.#events.onEvent?.(parsed.data, message.jsep);
        else this.malformed++;
        return;
      }
      case 'trickle':
        this.#events.onCandidate?.(message.candidate);
        return;
      case 'hangup':
        this.#events.onHangup?.(message.reason ?? 'Janus has hung up');
        return;
      case 'detached':
      case 'timeout':
        this.#fail(new JanusFailure('closed', 'Janus has ended the session'));
        return;
    }
  }

  #take(transaction: string | undefined): Waiting | undefined {
    if (transaction === undefined) return undefined;
    const waiting = this.#waiting.get(transaction);
    this.#waiting.delete(transaction);
    clearTimeout(waiting?.timer);
    return waiting;
  }

  #fail(failure: JanusFailure): void {
    if (this.#ended) return;
    const attached = this.#handle !== null;
    this.#end(failure);
    if (attached) this.#events.onClosed(failure);
  }

  #end(failure: JanusFailure): void {
    this.#ended = true;
    clearInterval(this.#keepAlive);
    this.#socket.onmessage = null;
    this.#socket.close();
    for (const { reject, timer } of this.#waiting.values()) {
      clearTimeout(timer);
      reject(failure);
    }
    this.#waiting.clear();
  }
}

function idOf(message: JanusMessage): number {
  const id = message.janus === 'success' ? message.data?.id : undefined;
  if (id === undefined) throw new JanusFailure('malformed', 'Janus gave no number');
  return id;
}
