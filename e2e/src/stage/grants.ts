/** Real grants and tickets, as whoever runs a fleet issues them, at the time of the stage's clock. */
import { encodeTicket, exportOperatorKey, type GrantClaims } from '@farpoint/grants';
import { grantTo, makeIssuer } from '@farpoint/grants/testing';
import type { Welcome } from '@farpoint/protocol';
import type { StageControl } from '@farpoint/webxr/stage-control';
import type { Page } from '@playwright/test';
import { OPENED_AT } from './stage.ts';

const NOW_S = OPENED_AT / 1000;
const issuer = await makeIssuer();

/** A grant for an hour. @param jkt thumbprint of the key that it is for */
export async function grantFor(jkt: string, change: Partial<GrantClaims> = {}): Promise<string> {
  return (await grantTo(issuer, NOW_S, { cnf: { jkt }, ...change })).grant;
}

/** A grant that ended when the page was opened. */
export function endedGrantFor(jkt: string): Promise<string> {
  return grantFor(jkt, { iat: NOW_S - 3600, nbf: NOW_S - 3600, exp: NOW_S });
}

/** A ticket for an hour: a grant and its key in one. */
export async function ticketFor(change: Partial<GrantClaims>): Promise<string> {
  const { grant, key } = await grantTo(issuer, NOW_S, change);
  return encodeTicket({ grant, key: await exportOperatorKey(key) });
}

/** The page's dialog. */
export function grantsDialog(page: Page) {
  const dialog = page.getByRole('dialog', { name: 'Grants' });
  return {
    own: dialog.getByLabel('This browser’s key'),
    text: dialog.getByLabel('Grant or ticket'),
    read: dialog.getByRole('status'),
    add: dialog.getByRole('button', { name: 'Add grant' }),
    signIn: dialog.getByRole('button', { name: 'Sign in' }),
    held: dialog.getByRole('list', { name: 'Grants in this browser' }).getByRole('listitem'),
  };
}

/** In the page: from now on the robot opens the sessions that are asked for. It says that the operator's grant allows this. */
export function admit({ robot }: StageControl, access: Welcome['access']): void {
  robot.access = access;
  Reflect.deleteProperty(robot, 'onRequest');
}

export interface StoredKey {
  /** Whether scripts can read it. */
  extractable: boolean;
  /** With this key. */
  grants: number;
}

/** What the page has stored: the browser's own key; `null` if there is none yet. */
export function storedKey(page: Page): Promise<StoredKey | null> {
  return page.evaluate(
    () =>
      new Promise<StoredKey | null>((resolve, reject) => {
        const open = indexedDB.open('farpoint');
        open.onerror = () => reject(open.error);
        open.onsuccess = () => {
          const all = open.result.transaction('access').objectStore('access').getAll();
          all.onerror = () => reject(all.error);
          all.onsuccess = () => {
            open.result.close();
            const [stored] = all.result as { own: { privateKey: CryptoKey } | null; grants: unknown[] }[];
            resolve(
              stored?.own == null
                ? null
                : { extractable: stored.own.privateKey.extractable, grants: stored.grants.length },
            );
          };
        };
      }),
  );
}
