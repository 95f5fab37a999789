/**
 * The operator's keys and grants in this browser's database. Private keys are stored as objects that no script can
 * read: they can sign, and that is all.
 */
import type { OperatorCredentials, OperatorKey } from '@farpoint/operator';
import { createStore, get, set, type UseStore } from 'idb-keyval';
import * as z from 'zod/mini';

export interface StoredAccess {
  /** This browser's own key. */
  readonly own: OperatorKey | null;
  readonly grants: readonly OperatorCredentials[];
}

export const NO_ACCESS: StoredAccess = { own: null, grants: [] };

/** Where access is kept; its methods never reject. */
export interface AccessStorage {
  load(): Promise<StoredAccess>;
  /** @returns whether it is kept beyond this visit */
  save(access: StoredAccess): Promise<boolean>;
}

const coordinate = z.string().check(z.regex(/^[A-Za-z0-9_-]{43}$/));
const publicJwk = z.strictObject({
  kty: z.literal('EC'),
  crv: z.literal('P-256'),
  x: coordinate,
  y: coordinate,
});
const keySchema = z.object({
  privateKey: z.custom<CryptoKey>((value) => value instanceof CryptoKey && value.usages.includes('sign')),
  publicJwk,
});
const schema = z.object({
  own: z.nullable(keySchema),
  grants: z.array(z.object({ grant: z.string().check(z.maxLength(4096)), key: keySchema })),
});

/** @param origin of the signaling service: grants are used there and nowhere else */
export function browserAccess(origin: string): AccessStorage {
  let store: UseStore | null = null;
  const name = `access ${origin}`;
  const opened = () => {
    store ??= createStore('farpoint', 'access');
    return store;
  };
  return {
    async load() {
      try {
        return schema.safeParse(await get(name, opened())).data ?? NO_ACCESS;
      } catch (error) {
        console.warn('grants cannot be read from this browser:', error);
        return NO_ACCESS;
      }
    },
    async save(access) {
      try {
        await set(name, access, opened());
        return true;
      } catch (error) {
        console.warn('grants cannot be kept in this browser:', error);
        return false;
      }
    },
  };
}
