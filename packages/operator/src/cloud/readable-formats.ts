import { CLOUD_FORMATS, type CloudFormat } from '@farpoint/protocol';

/** The formats of clouds that this browser reads: of those that it may, all but those that it failed to decode. */
export class ReadableFormats {
  readonly #allowed: readonly CloudFormat[];
  readonly #refused = new Set<CloudFormat>();

  constructor(allowed: readonly CloudFormat[] = CLOUD_FORMATS) {
    this.#allowed = allowed;
  }

  /** Its stream cannot be decoded here: it is not asked for any more. */
  refuse(format: CloudFormat): void {
    this.#refused.add(format);
  }

  get list(): CloudFormat[] {
    return this.#allowed.filter((format) => !this.#refused.has(format));
  }
}
