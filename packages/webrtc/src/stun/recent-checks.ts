/** Many times what a peer has under way. */
const MAX_CHECKS = 256;
const [ID_AT, ID_END] = [8, 20];

/**
 * The latest authentic connectivity checks, by their transactions. Somebody who has seen one can send it again: that
 * must not count as the peer's, nor begin a path to another address.
 */
export class RecentChecks {
  readonly #sources = new Map<string, string>();

  /**
   * @param check a STUN request
   * @returns `new`; `again`, as a peer repeats a check that is not answered; or `moved`: again, from another address
   */
  note(check: Buffer, host: string, port: number): 'new' | 'again' | 'moved' {
    const id = check.toString('latin1', ID_AT, ID_END);
    const source = `${host} ${port}`;
    const known = this.#sources.get(id);
    if (known !== undefined) return known === source ? 'again' : 'moved';
    this.#sources.set(id, source);
    if (this.#sources.size > MAX_CHECKS) this.#sources.delete(this.#sources.keys().next().value as string);
    return 'new';
  }
}
