/** The operator's own key and grants, for one signaling service. */
import {
  claimsOfGrant,
  type GrantClaims,
  keyThumbprint,
  makeOperatorKey,
  type OperatorCredentials,
  readTicket,
} from '@farpoint/operator';
import { type ReadonlySignal, signal } from '@preact/signals-core';
import { type AccessStorage, NO_ACCESS, type StoredAccess } from './stored-access.ts';

/** Grants that the browser keeps. Chosen: more than an operator has robots. */
export const MOST_GRANTS = 32;

/** A grant of this browser, as it is shown. */
export interface HeldGrant {
  readonly id: string;
  readonly claims: GrantClaims;
}

/** Why a text is not taken as a grant or ticket. */
export type GrantFault =
  | 'no-grant' // neither a grant nor a ticket
  | 'other-key' // made for another browser's key
  | 'bad-ticket' // its key is not the one that its grant names
  | 'expired'
  | 'too-many';

export type ReadResult =
  | { readonly credentials: OperatorCredentials; readonly claims: GrantClaims }
  | { readonly fault: GrantFault };

export class OperatorAccess {
  /** Thumbprint of this browser's own key; `null` until {@link makeKey}. */
  readonly ownKey: ReadonlySignal<string | null>;
  readonly grants: ReadonlySignal<readonly HeldGrant[]>;
  readonly #ownKey = signal<string | null>(null);
  readonly #grants = signal<readonly HeldGrant[]>([]);
  readonly #storage: AccessStorage;
  readonly #nowS: () => number;
  #access: StoredAccess = NO_ACCESS;
  readonly #loaded: Promise<void>;
  /** A grant that is being taken. Robots are shown nothing before that. */
  #taking: Promise<unknown> = Promise.resolve();

  /** @param nowS seconds since 1970 */
  constructor(storage: AccessStorage, nowS: () => number) {
    this.#storage = storage;
    this.#nowS = nowS;
    this.ownKey = this.#ownKey;
    this.grants = this.#grants;
    this.#loaded = storage.load().then((access) => this.#use(access));
  }

  /** What the operator can show to robots. */
  async credentials(): Promise<readonly OperatorCredentials[]> {
    await this.#loaded;
    await this.#taking;
    return this.#access.grants;
  }

  /** Makes this browser's own key, unless there is one. */
  async makeKey(): Promise<void> {
    await this.#loaded;
    if (this.#access.own !== null) return;
    await this.#change({ ...this.#access, own: await makeOperatorKey() });
  }

  /** What a text that the operator was given says. Nothing is kept yet. */
  async read(text: string): Promise<ReadResult> {
    await this.#loaded;
    const trimmed = text.trim();
    const ticket = await readTicket(trimmed);
    if (ticket === null && trimmed.startsWith('farpoint-ticket.')) return { fault: 'bad-ticket' };
    const grant = ticket?.grant ?? trimmed;
    const claims = claimsOfGrant(grant);
    if (claims === null) return { fault: 'no-grant' };
    if (claims.exp <= this.#nowS()) return { fault: 'expired' };
    if (ticket !== null) return { credentials: ticket, claims };
    const { own } = this.#access;
    if (own === null || (await keyThumbprint(own.publicJwk)) !== claims.cnf.jkt)
      return { fault: 'other-key' };
    return { credentials: { grant, key: own }, claims };
  }

  /** Keeps what {@link read} returned. @returns whether it is kept beyond this visit, or why not */
  async add({
    credentials,
    claims,
  }: Exclude<ReadResult, { fault: GrantFault }>): Promise<boolean | GrantFault> {
    const nowS = this.#nowS();
    const others = this.#access.grants.filter(({ grant }) => !isReplaced(claimsOfGrant(grant), claims, nowS));
    if (others.length >= MOST_GRANTS) return 'too-many';
    return await this.#change({ ...this.#access, grants: [...others, credentials] });
  }

  /**
   * Takes the grant that the page asked an issuer for: one for this browser's own key, and no ticket.
   *
   * @returns what it says, or why it is not taken
   */
  takeAsked(text: string): Promise<{ readonly claims: GrantClaims } | { readonly fault: GrantFault }> {
    const taken = this.#takeAsked(text);
    this.#taking = taken;
    return taken;
  }

  async #takeAsked(text: string) {
    const read = await this.read(text);
    if ('fault' in read) return read;
    if (read.credentials.key !== this.#access.own) return { fault: 'other-key' } as const;
    const kept = await this.add(read);
    return typeof kept === 'string' ? { fault: kept } : { claims: read.claims };
  }

  async remove(id: string): Promise<void> {
    await this.#loaded;
    const grants = this.#access.grants.filter(({ grant }) => claimsOfGrant(grant)?.jti !== id);
    await this.#change({ ...this.#access, grants });
  }

  async #change(access: StoredAccess): Promise<boolean> {
    await this.#use(access);
    return await this.#storage.save(access);
  }

  async #use(access: StoredAccess): Promise<void> {
    this.#access = access;
    this.#ownKey.value = access.own === null ? null : await keyThumbprint(access.own.publicJwk);
    this.#grants.value = access.grants.flatMap(({ grant }) => {
      const claims = claimsOfGrant(grant);
      return claims === null ? [] : [{ id: claims.jti, claims }];
    });
  }
}

/** Whether a grant is the same as a new one, or has ended and was for the same person. */
function isReplaced(one: GrantClaims | null, by: GrantClaims, nowS: number): boolean {
  if (one?.iss !== by.iss) return false;
  return one.jti === by.jti || (one.sub === by.sub && one.exp <= nowS);
}
