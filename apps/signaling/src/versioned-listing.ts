import {
  encodeJsonBytes,
  type RobotListing,
  type ServiceToOperator,
  serviceToOperatorCodec,
} from '@farpoint/protocol';

/** The list of robots as messages, and the changes since any recent version. */
export class VersionedListing {
  readonly #robots: ReadonlyMap<string, RobotListing>;
  readonly #remembered: number;
  /** Ids in the order of their changes: index i led to version `#oldest + i + 1`. */
  #changes: string[] = [];
  #oldest = 0;
  #whole: Uint8Array | null = null;
  /** Encoded once for all operators with the same version. */
  readonly #since = new Map<number, Uint8Array>();

  /**
   * @param robots read whenever a message is made; entries may contain more than the list sends
   * @param remembered number of changes to keep; an operator that is further behind gets the whole list
   */
  constructor(robots: ReadonlyMap<string, RobotListing>, remembered = 1024) {
    this.#robots = robots;
    this.#remembered = remembered;
  }

  get version(): number {
    return this.#oldest + this.#changes.length;
  }

  /** Call this when a robot was added, removed or renamed. */
  changed(id: string): void {
    this.#changes.push(id);
    // Half of the changes are dropped at once, so that the cost of a change does not depend on how many are kept.
    if (this.#changes.length > 2 * this.#remembered) {
      this.#oldest += this.#changes.length - this.#remembered;
      this.#changes = this.#changes.slice(-this.#remembered);
    }
    this.#whole = null;
    this.#since.clear();
  }

  /** The message `robots`. */
  whole(): Uint8Array {
    this.#whole ??= encode({ type: 'robots', robots: Array.from(this.#robots.values(), told) });
    return this.#whole;
  }

  /** The message `robots.changed` that updates a list of this version, or `robots` if the version is too old. */
  since(version: number): Uint8Array {
    if (version < this.#oldest) return this.whole();
    let message = this.#since.get(version);
    if (message === undefined) {
      const here: RobotListing[] = [];
      const gone: string[] = [];
      for (const id of new Set(this.#changes.slice(version - this.#oldest))) {
        const robot = this.#robots.get(id);
        if (robot === undefined) gone.push(id);
        else here.push(told(robot));
      }
      message = encode({ type: 'robots.changed', here, gone });
      this.#since.set(version, message);
    }
    return message;
  }
}

function told({ id, name }: RobotListing): RobotListing {
  return { id, name };
}

function encode(message: ServiceToOperator): Uint8Array {
  return encodeJsonBytes<ServiceToOperator>(serviceToOperatorCodec, message);
}
