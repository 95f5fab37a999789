import { CLOUD_FORMATS, type CloudFormat } from '@farpoint/protocol';

/** The cloud formats that this browser reads: the permitted ones, except those that it has failed to decode. */
export class ReadableFormats {
  readonly #allowed: readonly CloudFormat[];
  readonly #refused = new Set<CloudFormat>();

  constructor(allowed: readonly CloudFormat[] = CLOUD_FORMATS) {
    this.#allowed = allowed;
  }

  /** A stream of this format cannot be decoded here: the format is no longer requested. */
  refuse(format: CloudFormat): void {
    this.#refused.add(format);
  }

  get list(): CloudFormat[] {
    return this.#allowed.filter((format) => !this.#refused.has(format));
  }
}
