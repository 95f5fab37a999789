import type { LiveMessage, LiveServer } from '@farpoint/foxglove';
import { sequence32Of } from '@farpoint/protocol';
import type { ChannelSpec, McapFileWriter } from './mcap-file-writer.ts';

/** Where a message goes; both by default. */
export interface Destinations {
  file: boolean;
  live: boolean;
}

export interface MessageOptions {
  to?: Destinations;
  /** How live viewers must treat it when they lose messages. */
  link?: LiveMessage['link'];
}

type FileWriter = Pick<
  McapFileWriter,
  'abandon' | 'add' | 'addChannel' | 'bytes' | 'close' | 'flush' | 'messages' | 'sync'
>;

/** The receivers of a robot's messages: a file, live viewers, or both, with the same channels. */
export class MessageOutputs {
  readonly live: LiveServer | null;
  #file: FileWriter | null;
  #fileOpen: boolean;
  readonly #channels: { spec: ChannelSpec; live: number }[] = [];

  constructor(file: FileWriter | null, live: LiveServer | null) {
    this.#file = file;
    this.#fileOpen = file !== null;
    this.live = live;
  }

  /** Whether messages are still written to the file. */
  get fileOpen(): boolean {
    return this.#fileOpen;
  }

  /** Whether there is a receiver at all. */
  get open(): boolean {
    return this.#fileOpen || this.live !== null;
  }

  /** In the file. */
  get messages(): number {
    return this.#file?.messages ?? 0;
  }

  /** Of the file. */
  get bytes(): number {
    return this.#file?.bytes ?? 0;
  }

  /** @returns the channel's number, from 0 */
  addChannel(spec: ChannelSpec): number {
    if (this.#fileOpen) this.#file?.addChannel(spec);
    return this.#channels.push({ spec, live: this.live?.addChannel(spec) ?? 0 }) - 1;
  }

  /** Whether a live viewer subscribes to the channel. */
  wantsLive(channel: number): boolean {
    return this.live?.wants(this.#channels[channel]?.live ?? 0) ?? false;
  }

  /** Whether a message for these receivers has any. If not, it need not be made. */
  wants(channel: number, to?: Destinations): boolean {
    return (this.#fileOpen && to?.file !== false) || (to?.live !== false && this.wantsLive(channel));
  }

  /** The channel that live viewers know by this number; -1 if there is none. */
  channelOfLive(id: number): number {
    return this.#channels.findIndex(({ live }) => live === id);
  }

  /**
   * @param data one message in parts, which must not be changed until the promise is resolved
   * @throws {McapFileFull} if the file has no room for it; live viewers get it nevertheless
   */
  async add(
    channel: number,
    sequence: number,
    ns: bigint,
    data: readonly Uint8Array[],
    { to, link = 'alone' }: MessageOptions = {},
  ): Promise<void> {
    if (to?.live !== false && this.wantsLive(channel)) {
      // Viewers may read it long after the caller has used the memory of several parts again.
      const [only] = data;
      const bytes = data.length === 1 && only !== undefined ? only : Buffer.concat(data);
      this.live?.publish({ channel: this.#channels[channel]?.live ?? 0, ns, bytes, link });
    }
    if (this.#fileOpen && to?.file !== false)
      await this.#file?.add(channel, sequence32Of(sequence), ns, data);
  }

  /** Begins a file, with all channels so far. The one before must be closed or abandoned. */
  openFile(file: FileWriter): void {
    for (const { spec } of this.#channels) file.addChannel(spec);
    this.#file = file;
    this.#fileOpen = true;
  }

  async flush(): Promise<void> {
    if (this.#fileOpen) await this.#file?.flush();
  }

  async sync(): Promise<void> {
    if (this.#fileOpen) await this.#file?.sync();
  }

  /** Completes the file, if it is open. Live viewers go on. */
  async closeFile(): Promise<void> {
    if (!this.#fileOpen) return;
    this.#fileOpen = false;
    await this.#file?.close();
  }

  /** Nothing more is written to the file, which cannot be written. */
  abandonFile(): void {
    if (this.#fileOpen) this.#file?.abandon();
    this.#fileOpen = false;
  }
}
